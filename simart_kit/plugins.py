"""Finding, loading and naming plugins. One broken plugin never takes the tool down."""

from __future__ import annotations

import inspect
import os
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from importlib.metadata import EntryPoint, entry_points, version
from pathlib import Path
from typing import Any

import pluggy

from . import hookspecs
from .commands import PluginCommand, checked_name
from .errors import AmbiguousPluginError, PluginError, StageError, UnknownPluginError
from .plugin_import import import_plugin
from .stages import Check, Exporter, JointPredictor, Modifier, Options, Segmenter, Stage

DEFAULT_PLUGINS = (
    "simart_kit_plugins.loaders.trimesh_loader",
    "simart_kit_plugins.loaders.usd_loader",
    "simart_kit_plugins.adapters",
    "simart_kit_plugins.geometric",
    "simart_kit_plugins.hints",
    "simart_kit_plugins.simart",
    "simart_kit_plugins.nano",
    "simart_kit_plugins.p3sam",
    "simart_kit_plugins.marks",
    "simart_kit_plugins.particulate",
    "simart_kit_plugins.modifiers.scale",
    "simart_kit_plugins.modifiers.snap",
    "simart_kit_plugins.modifiers.sweep",
    "simart_kit_plugins.modifiers.mass",
    "simart_kit_plugins.modifiers.dynamics",
    "simart_kit_plugins.modifiers.collision",
    "simart_kit_plugins.modifiers.clear",
    "simart_kit_exporters.urdf",
    "simart_kit_exporters.mjcf",
    "simart_kit_exporters.usd",
    "simart_kit_exporters.usdz",
    "simart_kit_exporters.glb",
    "simart_kit.checks.builtin",
    "simart_kit_plugins.recorder:Recorder",
)
# Those of them with commands: all that the command line imports to list its commands.
COMMAND_PLUGINS = ("simart_kit_plugins.simart", "simart_kit_plugins.nano")
STAGE_HOOKS: dict[str, type[Stage]] = {
    "register_segmenters": Segmenter,
    "register_joint_predictors": JointPredictor,
    "register_modifiers": Modifier,
    "register_exporters": Exporter,
    "register_checks": Check,
}


@dataclass(frozen=True)
class Owner:
    """Where something registered came from.

    Attributes:
        plugin: its module, entry point or file name.
        distribution: installed distribution, "built in", or the file's path.
        version: version of the distribution, "" for a file.
    """

    plugin: str
    distribution: str
    version: str

    def __str__(self) -> str:
        return f"{self.plugin} ({self.distribution} {self.version})".replace(" )", ")")


@dataclass(frozen=True)
class Registration:
    """A stage class, a recipe file or a command under its name.

    Attributes:
        kind: "segmenter", "joint predictor", "modifier", "exporter", "check", "recipe" or "command".
        name: what recipes call it, or what is typed.
        value: the class, the recipe's path, or a `PluginCommand`.
        owner: where it came from.
    """

    kind: str
    name: str
    value: Any
    owner: Owner

    def failure(self, cause: BaseException) -> StageError:
        """The error that says that this stage, of this plugin, failed."""
        owner = self.owner
        return StageError(self.kind, self.name, owner.plugin, owner.distribution, owner.version, cause)


@dataclass(frozen=True)
class Failure:
    """A plugin that could not be loaded.

    Attributes:
        owner: where it came from.
        phase: "import" or "registration".
        error: one line.
        trace: the traceback, for `-v`.
    """

    owner: Owner
    phase: str
    error: str
    trace: str

    def __str__(self) -> str:
        return f"{self.owner.plugin} during {self.phase}: {self.error}"


class Plugins:
    """The plugins of one run or one test; nothing is shared between instances.

    Args:
        load: names of third-party plugins to load; None loads all installed ones. The default comes from
            SIMART_LOAD_PLUGINS, a list with commas; an empty one loads none.
        strict: raise the first failure instead of recording it; the default is whether
            SIMART_STRICT_PLUGINS is "1".
        files: Python files to load as plugins besides.
        installed: whether to look for installed third-party plugins at all.
        commands_only: leave out what built-in plugins have besides commands, for a quick start.

    Attributes:
        manager: the pluggy manager; objects are registered by `register`, which knows whose they are.
        failures: plugins that did not load.
    """

    def __init__(
        self,
        *,
        load: Iterable[str] | None = None,
        strict: bool | None = None,
        files: Iterable[Path] = (),
        installed: bool = True,
        commands_only: bool = False,
    ) -> None:
        chosen = os.environ.get("SIMART_LOAD_PLUGINS")
        if load is None and chosen is not None:
            load = [name.strip() for name in chosen.split(",") if name.strip()]
        wanted = None if load is None else set(load)
        self._strict = os.environ.get("SIMART_STRICT_PLUGINS") == "1" if strict is None else strict
        self.manager = pluggy.PluginManager("simart_kit")
        self.manager.add_hookspecs(hookspecs)
        self.failures: tuple[Failure, ...] = ()
        self._registrations: list[Registration] = []
        self._owners: dict[int, Owner] = {}
        own_version = version("simart-kit")
        for name in COMMAND_PLUGINS if commands_only else DEFAULT_PLUGINS:
            self._load(Owner(name, "built in", own_version), name, commands_only)
        for point in _entry_points() if installed else ():
            if wanted is None or point.name in wanted:
                dist = point.dist
                self._load(Owner(point.name, dist.name if dist else "?", dist.version if dist else ""), point)
        for file in files:
            self._load(Owner(file.stem, str(file), ""), file)

    def register(self, plugin: object, owner: Owner | None = None, *, commands_only: bool = False) -> None:
        """Add a plugin object; raises what its registration raises. Tests use this with fakes."""
        owner = owner or Owner(getattr(plugin, "__name__", type(plugin).__name__), "registered object", "")
        if self.manager.is_registered(plugin):
            raise PluginError(f"plugin {owner} is registered already")
        try:
            self.manager.register(plugin, name=f"{owner.plugin}-{id(plugin)}")
            self.manager.check_pending()
            pending = self._collect(plugin, owner, commands_only)
        except Exception:
            if self.manager.is_registered(plugin):
                self.manager.unregister(plugin)
            raise
        self._owners[id(plugin)] = owner
        self._registrations += pending

    def registrations(self, kind: str | None = None) -> tuple[Registration, ...]:
        """Everything registered, or all of one kind, in loading order."""
        return tuple(r for r in self._registrations if kind in (None, r.kind))

    def notify(self, hook: str, arguments: Mapping[str, object]) -> list[tuple[Owner, Exception]]:
        """Call an observer hook of every plugin in loading order; returns who failed, and how."""
        failed = []
        for implementation in getattr(self.manager.hook, hook).get_hookimpls():
            try:
                implementation.function(**{name: arguments[name] for name in implementation.argnames})
            except Exception as error:
                failed.append((self._owners[id(implementation.plugin)], error))
        return failed

    def hooks(self) -> tuple[tuple[Owner, tuple[str, ...]], ...]:
        """Every loaded plugin with the hooks that it implements, in loading order."""
        loaded = [(plugin, self._owners[id(plugin)]) for _, plugin in self.manager.list_name_plugin()]
        return tuple(
            (owner, tuple(sorted(caller.name for caller in self.manager.get_hookcallers(plugin) or ())))
            for plugin, owner in loaded
        )

    def find(self, kind: str, name: str) -> Registration:
        """The one registration of this kind and name.

        Raises:
            UnknownPluginError: there is none; lists those that exist and the plugins that failed to load.
            AmbiguousPluginError: there are several; names their owners.
        """
        found = [r for r in self.registrations(kind) if r.name == name]
        if not found:
            known = {r.name for r in self.registrations(kind)}
            raise UnknownPluginError(kind, name, known, [str(f) for f in self.failures])
        if len(found) > 1:
            raise AmbiguousPluginError(kind, name, [str(r.owner) for r in found])
        return found[0]

    def conflicts(self) -> tuple[tuple[Registration, ...], ...]:
        """Groups of registrations that share kind and name."""
        groups: dict[tuple[str, str], list[Registration]] = {}
        for registration in self._registrations:
            groups.setdefault((registration.kind, registration.name), []).append(registration)
        return tuple(tuple(group) for group in groups.values() if len(group) > 1)

    def _load(self, owner: Owner, source: str | EntryPoint | Path, commands_only: bool = False) -> None:
        phase = "import"
        try:
            plugin = import_plugin(source)
            phase = "registration"
            made = plugin() if isinstance(plugin, type) else plugin
            if not any(self.manager.parse_hookimpl_opts(made, name) for name in dir(made)):
                raise PluginError(
                    "no hook: mark functions named in docs/plugins.md with @simart_kit.hookimpl"
                )
            self.register(made, owner, commands_only=commands_only)
        except (Exception, SystemExit) as error:
            text = " ".join(str(error).split()) or type(error).__name__
            failure = Failure(owner, phase, f"{type(error).__name__}: {text}", traceback.format_exc())
            if self._strict:
                raise PluginError(f"plugin {failure}") from error
            self.failures += (failure,)

    def _collect(self, plugin: object, owner: Owner, commands_only: bool) -> list[Registration]:
        """Call the plugin's own register hooks; nothing is kept if one raises."""
        pending: list[Registration] = []
        registers: dict[str, Callable[..., None]] = {}
        if not commands_only:
            for hook, base in STAGE_HOOKS.items():
                registers[hook] = lambda stage, base=base: pending.append(_checked(stage, base, owner))
            registers["register_recipes"] = lambda name, path: pending.append(
                Registration("recipe", name, Path(path), owner)
            )
        registers["register_commands"] = lambda name, target, help, extra="": pending.append(
            Registration("command", checked_name(name, str(owner)), PluginCommand(target, help, extra), owner)
        )
        for hook, register in registers.items():
            implementation = self._implementation(plugin, hook)
            if implementation:
                implementation(register=register)
        return pending

    def _implementation(self, plugin: object, hook: str) -> Any:
        for implementation in getattr(self.manager.hook, hook).get_hookimpls():
            if implementation.plugin is plugin:
                return implementation.function
        return None


def _checked(stage: Any, base: type[Stage], owner: Owner) -> Registration:
    if not (isinstance(stage, type) and issubclass(stage, base)):
        raise TypeError(f"{stage!r} is not a subclass of simart_kit.{base.__name__}")
    name = getattr(stage, "name", None)
    if not isinstance(name, str) or not name:
        raise TypeError(f"{stage.__name__} needs a class attribute `name`, such as name = 'mine'")
    if inspect.isabstract(stage):
        missing = ", ".join(sorted(stage.__abstractmethods__))
        raise TypeError(f"{stage.__name__} does not implement {missing}()")
    if not (isinstance(stage.Options, type) and issubclass(stage.Options, Options)):
        raise TypeError(f"{stage.__name__}.Options is not a subclass of simart_kit.Options")
    return Registration(base.kind, name, stage, owner)


def _entry_points() -> list[EntryPoint]:
    """Installed plugins in an order that does not depend on the file system."""
    found = entry_points(group="simart_kit")
    return sorted(found, key=lambda p: (p.dist.name if p.dist else "", p.name))
