"""Recipes: parents, changes from the command line, and mistakes told all at once."""

import json
import tomllib
from pathlib import Path
from typing import Literal

import pytest

import simart_kit as sk
from simart_kit.errors import AmbiguousPluginError, RecipeError, StageError
from simart_kit.plugins import Failure, Owner, Plugins
from simart_kit.recipe import Use, build, load_recipe
from simart_kit.recipe_files import apply_set, known_recipes, packaged_recipes
from simart_kit.toml_text import recipe_text

BASE = """
schema = 1
description = "base"
seed = 1
[segmenter]
use = "boxes"
options = { max_parts = 4, sizes = [1.0, 2.0] }
[joints]
use = "none"
[[modify]]
use = "tint"
options = { mode = "soft" }
[[modify]]
use = "press"
[[export]]
use = "text"
"""


class Boxes(sk.Segmenter):
    name = "boxes"

    class Options(sk.Options):
        max_parts: int = 8
        sizes: tuple[float, float] = (0.0, 1.0)
        label: str | None = None

    def segment(self, mesh):
        raise NotImplementedError


class Spheres(Boxes):
    name = "spheres"


class Nothing(sk.JointPredictor):
    name = "none"

    def predict(self, mesh, segmentation):
        raise NotImplementedError


class Tint(sk.Modifier):
    name = "tint"

    class Options(sk.Options):
        mode: Literal["soft", "hard"] = "soft"

    def modify(self, asset):
        raise NotImplementedError


class Press(sk.Modifier):
    name = "press"

    class Options(sk.Options):
        force: float = 1.0

    def __init__(self, options=None, *, seed=0):
        super().__init__(options, seed=seed)
        if self.options.force < 0:
            raise ValueError("cannot pull")

    def modify(self, asset):
        raise NotImplementedError


class Text(sk.Exporter):
    name = "text"

    def export(self, asset, directory):
        raise NotImplementedError


class Other(Text):
    name = "other"


class Fakes:
    @sk.hookimpl
    def register_segmenters(self, register):
        register(Boxes)
        register(Spheres)

    @sk.hookimpl
    def register_joint_predictors(self, register):
        register(Nothing)

    @sk.hookimpl
    def register_modifiers(self, register):
        register(Tint)
        register(Press)

    @sk.hookimpl
    def register_exporters(self, register):
        register(Text)
        register(Other)


class Ships:
    """A plugin that brings recipes."""

    def __init__(self, **recipes: Path) -> None:
        self.recipes = recipes

    @sk.hookimpl
    def register_recipes(self, register):
        for name, path in self.recipes.items():
            register(name, path)


@pytest.fixture
def plugins() -> Plugins:
    plugins = Plugins(installed=False)
    plugins.register(Fakes(), Owner("fakes", "fakes", "1"))
    return plugins


def test_every_packaged_recipe_validates():
    plugins = Plugins(installed=False)

    assert {"default", "usd", "urdf", "mjcf", "all", "geometric"} <= set(packaged_recipes())
    for name in packaged_recipes():
        assert load_recipe(name, plugins).description


def test_tables_merge_arrays_replace_and_a_new_use_drops_the_parents_options(write, plugins):
    write("base.toml", BASE)
    write(
        "child.toml", 'extends = "base.toml"\n[segmenter.options]\nmax_parts = 9\n[[export]]\nuse = "other"'
    )
    grandchild = write("deep/er.toml", 'extends = "../child.toml"\nseed = 5\n[joints]\nuse = "none"')
    swapped = write("swap.toml", 'extends = "base.toml"\n[segmenter]\nuse = "spheres"')

    recipe = load_recipe(grandchild, plugins)
    assert recipe.seed == 5
    assert recipe.segmenter == Use(use="boxes", options={"max_parts": 9, "sizes": [1.0, 2.0], "label": None})
    assert [u.use for u in recipe.modify] == ["tint", "press"]
    assert [u.use for u in recipe.export] == ["other"]
    assert load_recipe(swapped, plugins).segmenter == Use(
        use="spheres", options={"max_parts": 8, "sizes": [0.0, 1.0], "label": None}
    )


@pytest.mark.parametrize("back", ["a.toml", "../x/a.toml", "./a.toml"])
def test_a_loop_of_parents_is_told(write, plugins, back):
    first = write("x/a.toml", 'extends = "b.toml"')
    write("x/b.toml", f'extends = "{back}"')

    with pytest.raises(RecipeError, match="extend each other in a loop"):
        load_recipe(first, plugins)


def test_an_unknown_parent_is_told_with_who_asked(write, plugins):
    child = write("child.toml", 'extends = "nobody"')

    with pytest.raises(RecipeError, match=r"unknown recipe 'nobody': .*known are .*default.*usd"):
        load_recipe(child, plugins)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("schema = ", "cannot read recipe"),
        ('extends = ["a", "b"]', "extends must be one recipe name or file"),
    ],
)
def test_an_unreadable_recipe_is_told(write, plugins, text, reason):
    with pytest.raises(RecipeError, match=reason):
        load_recipe(write("bad.toml", text), plugins)


@pytest.mark.parametrize("text", ["{", "[]", '{"outputs": {}}'])
def test_a_json_file_without_a_recipe_is_told(write, plugins, text):
    with pytest.raises(RecipeError, match="cannot read recipe"):
        load_recipe(write("provenance.json", text), plugins)


def test_a_recipe_reads_back_from_its_toml_text_and_from_a_record(write, plugins):
    text = BASE.replace('"base"', '"quo\\"te \\u00e9 \\u007f"')
    recipe = load_recipe(write("base.toml", text), plugins, ["export=[]", "segmenter.options.label=a.b"])

    from_text = load_recipe(write("again.toml", recipe_text(recipe)), plugins)
    from_record = load_recipe(
        write("provenance.json", json.dumps({"schema": 1, "recipe": recipe.table()})), plugins
    )

    assert from_text == recipe
    assert from_record == recipe


def test_a_plugins_recipe_is_known_by_name(write, plugins):
    plugins.register(Ships(shipped=write("base.toml", BASE)))

    assert load_recipe("shipped", plugins).description == "base"


def test_a_plugin_cannot_replace_a_packaged_recipe(write, plugins):
    plugins.register(Ships(default=write("base.toml", BASE)))

    assert known_recipes(plugins)["default"] == packaged_recipes()["default"]


def test_an_exporter_listed_twice_is_told_before_anything_runs(write, plugins):
    path = write("twice.toml", BASE + BASE[BASE.index("[[export]]") :])
    with pytest.raises(RecipeError, match="listed twice"):
        load_recipe(path, plugins)


def test_two_plugins_with_one_recipe_name_conflict_when_it_is_used(write, plugins):
    for owner in ("first", "second"):
        plugins.register(Ships(shared=write(f"{owner}.toml", BASE)), Owner(owner, owner, "1"))

    with pytest.raises(AmbiguousPluginError, match=r"'shared' .*first \(first 1\) and by second"):
        load_recipe("shared", plugins)


@pytest.mark.parametrize(
    ("change", "place", "value"),
    [
        ("seed=12", ("seed",), 12),
        ("description=plain words", ("description",), "plain words"),
        ("segmenter.options.max_parts=8", ("segmenter", "options", "max_parts"), 8),
        ("segmenter.options.sizes=[3.0, 4.0]", ("segmenter", "options", "sizes"), [3.0, 4.0]),
        ('segmenter.options.label="a=b"', ("segmenter", "options", "label"), "a=b"),
        ("modify.tint.options.mode=hard", ("modify", 0, "options", "mode"), "hard"),
        ("modify.press.options.force = 2.5", ("modify", 1, "options", "force"), 2.5),
        ('export=[{use="other"}]', ("export",), [{"use": "other"}]),
        ("modify=[]", ("modify",), []),
        ("segmenter.use=spheres", ("segmenter",), {"use": "spheres"}),
    ],
)
def test_set_changes_one_place(change, place, value):
    table = tomllib.loads(BASE)

    changed = apply_set(table, change)

    found = changed
    for key in place:
        found = found[key]
    assert found == value
    assert table == tomllib.loads(BASE)


def test_set_reaches_every_entry_of_that_use_and_no_other():
    table = apply_set(tomllib.loads(BASE), 'modify=[{use="tint"}, {use="press"}, {use="tint"}]')

    changed = apply_set(table, "modify.tint.options.mode=hard")

    assert changed["modify"] == [
        {"use": "tint", "options": {"mode": "hard"}},
        {"use": "press"},
        {"use": "tint", "options": {"mode": "hard"}},
    ]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ("seed", "write key=value"),
        ("=3", "write key=value"),
        ("modify.snap.options.mode=1", "list has no 'snap': it has tint, press"),
        ("modify.tint=1", "name a field too"),
        ("extends=usd", "extends"),
        ("segmenter.options.maximum=1", "known are max_parts, sizes, label"),
        ("segmenter.max_parts=1", r"segmenter\.max_parts: no such key .*, known are use, options"),
        ("modify.tint.mode=1", "mode: no such key .*, known are use, options"),
        ("colour=red", "colour: no such key .*, known are extends, schema, "),
        ("physics.material=oak", r"physics\.material: no such key .*, known are materials, parts"),
        ("physics.parts.lid.weight=1", "weight: no such key .*, known are material, density, .*mass"),
        ("physics.materials.oak.weight=1", "weight: no such key .*, known are density, friction"),
        ("seed=1.5", "seed"),
        ("modify=3", "modify"),
        ("stage_timeout=inf", "stage_timeout"),
    ],
)
def test_a_wrong_set_is_told(write, plugins, change, reason):
    with pytest.raises(RecipeError, match=reason):
        load_recipe(write("base.toml", BASE), plugins, [change])


def test_a_set_into_a_list_that_is_none_is_told():
    with pytest.raises(RecipeError, match="not a list of tables"):
        apply_set({"modify": "tint"}, "modify.tint.options.mode=hard")


def test_five_mistakes_are_told_at_once(write, plugins):
    path = write(
        "wrong.toml",
        """
        schema = 1
        seeed = 3
        stage_timeout = "long"
        [segmenter]
        use = "boxes"
        options = { max_parts = "many" }
        [joints]
        use = "magic"
        [[modify]]
        use = "tint"
        options = { mode = "loud" }
        """,
    )

    with pytest.raises(RecipeError) as caught:
        load_recipe(path, plugins)

    line = str(caught.value)
    assert "has 5 mistake(s)" in line
    for told in (
        "seeed: ",
        "stage_timeout: ",
        "segmenter.options.max_parts: ",
        "joints: unknown joint predictor 'magic'",
        "modify.tint.options.mode: ",
    ):
        assert told in line
    assert "\n" not in line


def test_an_unknown_stage_names_known_ones_and_plugins_that_failed_once(write, plugins):
    plugins.failures = (Failure(Owner("shaky", "shaky-dist", "2"), "import", "ImportError: no gpu", ""),)
    path = write("base.toml", BASE)

    with pytest.raises(RecipeError) as caught:
        load_recipe(path, plugins, ["segmenter.use=lasso", "joints.use=magic"])

    line = str(caught.value)
    assert "recipe 'base.toml' with changes of 'segmenter.use, joints.use' has 2 mistake(s)" in line.replace(
        f"{path.parent}/", ""
    )
    assert "unknown segmenter 'lasso': known are " in line
    assert "boxes" in line
    assert line.count("shaky during import: ImportError: no gpu") == 1


def test_build_passes_options_and_seed(plugins):
    stage, registration = build(Use(use="boxes", options={"max_parts": 3}), sk.Segmenter, plugins, 11)

    assert (stage.options.max_parts, stage.seed, registration.value) == (3, 11, Boxes)


def test_build_names_a_stage_whose_constructor_fails(plugins):
    with pytest.raises(StageError, match=r"modifier 'press' failed \(plugin fakes, fakes 1\): .*cannot pull"):
        build(Use(use="press", options={"force": -1.0}), sk.Modifier, plugins, 0)
