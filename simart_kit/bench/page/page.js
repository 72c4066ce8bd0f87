"use strict";
(() => {
  const table = document.getElementById("objects");
  const headings = [...table.tHead.querySelectorAll("th[data-key]")];
  const bodies = [...table.tBodies];
  const filter = document.getElementById("filter");
  const shown = document.getElementById("shown");
  const viewer = document.getElementById("viewer");
  let sort = null; // {key, up}; null for failures first, then worst first

  const byKey = (body) => new Map([...body.rows[0].cells].map((cell) => [cell.dataset.key, cell.dataset.value]));
  const values = new Map(bodies.map((body) => [body, byKey(body)]));
  const words = new Map(
    bodies.map((body) => {
      const value = values.get(body);
      const error = body.querySelector(".error");
      return [body, [value.get("name"), value.get("category"), error ? error.textContent : ""].join("\n").toLowerCase()];
    }),
  );

  function compare(heading, up) {
    const { key, better } = heading.dataset;
    return (one, two) => {
      const [a, b] = [values.get(one).get(key), values.get(two).get(key)];
      if (a === undefined || b === undefined) return (a === undefined) - (b === undefined); // none is last
      const order = better ? Number(a) - Number(b) : a.localeCompare(b, "en", { numeric: true });
      return up ? order : -order;
    };
  }

  function order() {
    const heading = sort && headings.find((h) => h.dataset.key === sort.key);
    bodies.sort((one, two) => one.dataset.rank - two.dataset.rank);
    if (heading) bodies.sort(compare(heading, sort.up));
    for (const h of headings) {
      h.setAttribute("aria-sort", h !== heading ? "none" : sort.up ? "ascending" : "descending");
    }
    table.append(...bodies);
  }

  function wanted(body) {
    const show = document.querySelector("input[name=show]:checked").value;
    const text = filter.value.trim().toLowerCase();
    return (show === "all" || show in body.dataset) && words.get(body).includes(text);
  }

  function select() {
    let count = 0;
    for (const body of bodies) {
      body.hidden = !wanted(body);
      count += !body.hidden;
    }
    shown.textContent = count === bodies.length ? "" : `${count} of ${bodies.length} shown`;
  }

  function remember() {
    const state = new URLSearchParams();
    if (sort) {
      state.set("sort", sort.key);
      state.set("order", sort.up ? "up" : "down");
    }
    const show = document.querySelector("input[name=show]:checked").value;
    if (show !== "all") state.set("show", show);
    if (filter.value) state.set("filter", filter.value);
    history.replaceState(null, "", `#${state}`);
  }

  function recall() {
    const state = new URLSearchParams(location.hash.slice(1));
    const key = state.get("sort");
    sort = headings.some((h) => h.dataset.key === key) ? { key, up: state.get("order") !== "down" } : null;
    const radios = [...document.querySelectorAll("input[name=show]")];
    (radios.find((radio) => radio.value === state.get("show")) || radios[0]).checked = true;
    filter.value = state.get("filter") || "";
    order();
    select();
  }

  function toggle(button) {
    const open = button.getAttribute("aria-expanded") !== "true";
    button.setAttribute("aria-expanded", String(open));
    document.getElementById(button.getAttribute("aria-controls")).hidden = !open;
  }

  function figure(cell, chosen) {
    const result = document.createElement("figure");
    const image = document.createElement("img");
    const source = cell.querySelector("img");
    image.src = source.src;
    image.alt = source.alt;
    const caption = document.createElement("figcaption");
    caption.textContent = table.tHead.rows[0].cells[cell.cellIndex].textContent;
    result.dataset.picture = cell.dataset.picture;
    result.classList.toggle("chosen", cell.dataset.picture === chosen);
    result.append(image, caption);
    return result;
  }

  function view(body, chosen) {
    const cells = [...body.rows[0].querySelectorAll("[data-picture]")].filter((cell) => cell.querySelector("img"));
    viewer.dataset.rank = body.dataset.rank;
    viewer.dataset.chosen = chosen;
    document.getElementById("viewer-title").textContent = values.get(body).get("name");
    viewer.querySelector(".views").replaceChildren(...cells.map((cell) => figure(cell, chosen)));
    if (!viewer.open) viewer.showModal();
  }

  function step(by) {
    const seen = bodies.filter((body) => !body.hidden && body.querySelector("img"));
    const at = seen.findIndex((body) => body.dataset.rank === viewer.dataset.rank);
    const next = seen[at + by];
    if (next) view(next, viewer.dataset.chosen);
  }

  table.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (!button) return;
    const heading = button.closest("thead th");
    if (heading) {
      const { key, better } = heading.dataset;
      const first = better !== "lower"; // the worst first, or A to Z
      sort = { key, up: sort && sort.key === key ? !sort.up : first };
      order();
      remember();
    } else if (button.classList.contains("toggle")) {
      toggle(button);
    } else if (button.classList.contains("thumbnail")) {
      view(button.closest("tbody"), button.closest("td").dataset.picture);
    }
  });
  document.getElementById("worst").addEventListener("click", () => {
    sort = null;
    order();
    remember();
  });
  for (const control of document.querySelectorAll(".tools input")) {
    control.addEventListener("input", () => {
      select();
      remember();
    });
  }
  document.querySelector(".tools").addEventListener("submit", (event) => event.preventDefault());
  viewer.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (event.target === viewer || (button && "close" in button.dataset)) viewer.close();
    else if (button) step(Number(button.dataset.step));
  });
  viewer.addEventListener("keydown", (event) => {
    if (event.key === "ArrowLeft") step(-1);
    if (event.key === "ArrowRight") step(1);
  });
  document.querySelector("[data-plain]").addEventListener("click", (event) => {
    event.preventDefault(); // the address keeps the sort
    document.getElementById("explanations").scrollIntoView();
  });
  window.addEventListener("hashchange", recall);
  recall();
})();
