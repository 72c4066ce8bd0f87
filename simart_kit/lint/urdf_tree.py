"""URDF as a tree: names, ends of joints, one root, no loop."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from xml.etree.ElementTree import Element

from .findings import Finding


def tree_findings(robot: Element) -> Iterator[Finding]:
    """Breaches by the links and joints as a graph."""
    links = [link.get("name", "") for link in robot.findall("link")]
    if not links:
        yield Finding("body-missing", "", "there is no <link>: add one")
        return
    yield from _name_findings(robot)
    ends: list[tuple[str, str]] = []
    for joint in robot.findall("joint"):
        parent, child, name = end(joint, "parent"), end(joint, "child"), joint.get("name", "")
        missing = [(tag, link) for tag, link in (("parent", parent), ("child", child)) if link not in links]
        for tag, link in missing:
            yield Finding(
                "joint-target-missing", name, f"its {tag} link '{link}' does not exist: name one that does"
            )
        if parent == child and not missing:
            yield Finding("joint-self", name, f"it connects link '{parent}' to itself: name another child")
        elif not missing:
            ends.append((parent, child))
    yield from _graph_findings(list(dict.fromkeys(links)), ends, _broken(robot, links))


def end(joint: Element, tag: str) -> str:
    """The link that a joint names as its "parent" or "child"; "" for none."""
    found = joint.find(tag)
    return "" if found is None else found.get("link", "")


def _broken(robot: Element, links: list[str]) -> bool:
    """Whether some joint has no two ends: links without a joint are then told of already."""
    ends = [(end(joint, "parent"), end(joint, "child")) for joint in robot.findall("joint")]
    return any(not {*pair} <= {*links} or pair[0] == pair[1] for pair in ends)


def _name_findings(robot: Element) -> Iterator[Finding]:
    for tag in ("link", "joint"):
        counts = Counter(element.get("name", "") for element in robot.findall(tag))
        if counts.pop("", 0):
            yield Finding("name-missing", "", f"a <{tag}> has no name: give it one")
        for name, count in counts.items():
            if count > 1:
                yield Finding("name-duplicate", name, f"{count} <{tag}> elements have this name: rename them")


def _graph_findings(links: list[str], ends: list[tuple[str, str]], broken: bool) -> Iterator[Finding]:
    parents = Counter(child for _, child in ends)
    for link in [name for name, count in parents.items() if count > 1]:
        yield Finding("joint-loop", link, f"{parents[link]} joints move this link: cut the loop")
    roots = [link for link in links if link not in parents]
    loose = _unreached(links, ends, roots)
    if loose:
        yield Finding("joint-loop", loose[0], f"the joints of {_listed(loose)} form a loop: cut it")
    # Where a joint names no link, its child is loose for that reason.
    if len(roots) > 1 and not broken:
        biggest = max(roots, key=lambda root: len(links) - len(_unreached(links, ends, [root])))
        for root in roots:
            if root != biggest:
                yield Finding(
                    "link-orphan", root, f"no joint connects it with '{biggest}': add one, or drop it"
                )


def _unreached(links: list[str], ends: list[tuple[str, str]], roots: list[str]) -> list[str]:
    """The links that joints do not lead to from the roots."""
    children: dict[str, list[str]] = {}
    for parent, child in ends:
        children.setdefault(parent, []).append(child)
    seen, waiting = set(roots), list(roots)
    while waiting:
        new = [child for child in children.get(waiting.pop(), []) if child not in seen]
        seen.update(new)
        waiting += new
    return [link for link in links if link not in seen]


def _listed(names: list[str]) -> str:
    return ", ".join(f"'{name}'" for name in names[:4]) + (" ..." if len(names) > 4 else "")
