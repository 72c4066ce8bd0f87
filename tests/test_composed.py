"""A stage that makes use of another by its name finds it among the plugins of the run."""

from simart_kit.plugins import Plugins
from simart_kit.recipe import Use, build
from simart_kit.stages import Composed, Segmentation, Segmenter
from simart_kit.testing import fakes


class Relay(Composed, Segmenter):
    """Leaves its work to the segmenter `fake`."""

    name = "relay"

    def segment(self, mesh) -> Segmentation:
        assert self.plugins is not None
        stage, _ = build(Use(use="fake"), Segmenter, self.plugins, self.seed)
        return stage.segment(mesh)


def test_a_composed_stage_is_given_the_plugins_of_the_run(simart_plugins: Plugins) -> None:
    simart_plugins.register(fakes.plugin(Relay))
    stage, _ = build(Use(use="relay"), Segmenter, simart_plugins, 7)
    assert isinstance(stage, Relay)
    assert stage.plugins is simart_plugins
    assert stage.seed == 7


def test_made_by_hand_it_has_none() -> None:
    assert Relay().plugins is None
