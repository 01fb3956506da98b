# SPDX-License-Identifier: GPL-3.0-or-later
"""What a render has to say to its user: a log without repetitions, and where the UI finds it.

Entries come from the exporter and from the core. They are counted instead of repeated, given to
Blender once (`DiagnosticsLog.flush`), and kept per scene and view layer for the panel.
"""

from collections import defaultdict
from dataclasses import dataclass, field

SEVERITIES = ("ERROR", "WARNING", "INFO")
MAX_REPORTED = 20


class RenderRefused(Exception):
    """The scene or the installation cannot be rendered; the message is written for the user."""


class RenderCancelled(Exception):
    """The user stopped the render before there was anything to show."""


@dataclass(frozen=True)
class Entry:
    """One finding, with the names of what it is about (empty where there is none)."""

    severity: str
    message: str
    object: str = ""
    material: str = ""
    node: str = ""

    def __str__(self) -> str:
        named = (("object", self.object), ("material", self.material), ("node", self.node))
        where = ", ".join(f"{kind} '{name}'" for kind, name in named if name)
        return f"{where[0].upper()}{where[1:]}: {self.message}" if where else self.message


@dataclass
class DiagnosticsLog:
    """Collects findings in order, counting equal ones."""

    counts: dict[Entry, int] = field(default_factory=dict)
    _flushed: set[Entry] = field(default_factory=set)

    def add(self, entry: Entry, count: int = 1) -> None:
        self.counts[entry] = self.counts.get(entry, 0) + count

    def info(self, message: str, **names: str) -> None:
        self.add(Entry("INFO", message, **names))

    def warning(self, message: str, **names: str) -> None:
        self.add(Entry("WARNING", message, **names))

    def error(self, message: str, **names: str) -> None:
        self.add(Entry("ERROR", message, **names))

    def extend(self, diagnostics) -> None:
        """Takes over the core's findings. None of them is fatal: the core raises what is."""
        for found in diagnostics:
            severity = "INFO" if found.severity == "INFO" else "WARNING"
            names = (found.object or "", found.material or "", found.node or "")
            self.add(Entry(severity, found.message, *names))

    def entries(self, severity: str | None = None) -> list[tuple[Entry, int]]:
        """(entry, count), the gravest first, otherwise in the order of first appearance."""
        wanted = SEVERITIES if severity is None else (severity,)
        return [(e, n) for s in wanted for e, n in self.counts.items() if e.severity == s]

    def flush(self, engine) -> None:
        """Gives Blender what it has not seen yet. An ERROR makes the render fail.

        INFO stays in the panel: a report of it would cover the status bar at each render.
        """
        fresh = [(e, n) for e, n in self.entries() if e not in self._flushed]
        self._flushed.update(e for e, _ in fresh)
        warnings = [(e, n) for e, n in fresh if e.severity == "WARNING"]
        for entry, count in warnings[:MAX_REPORTED]:
            engine.report({"WARNING"}, counted(entry, count))
        if len(warnings) > MAX_REPORTED:
            rest = len(warnings) - MAX_REPORTED
            engine.report({"WARNING"}, f"{rest} more warnings: see Render properties, Janus Report")
        for entry, count in fresh:
            if entry.severity == "ERROR":
                engine.report({"ERROR"}, counted(entry, count))


def counted(entry: Entry, count: int) -> str:
    return f"{entry} ({count} times)" if count > 1 else str(entry)


# scene name -> view layer name -> log of the last render. Read by the panel only.
_kept: dict[str, dict[str, DiagnosticsLog]] = defaultdict(dict)


def keep(scene: str, view_layer: str, layers: list[str], log: DiagnosticsLog) -> None:
    """Keeps a finished log for the panel and drops those of view layers that are gone."""
    logs = _kept[scene]
    logs[view_layer] = log
    for name in set(logs) - set(layers):
        del logs[name]


def keep_of_viewport(scene: str, view_layer: str, layers: list[str], log: DiagnosticsLog) -> None:
    """The same of a viewport, in place of the last render's. Why that failed is still to be read
    until the next render."""
    before = _kept[scene].get(view_layer)
    for entry, count in before.entries("ERROR") if before else ():
        if entry not in log.counts:
            log.add(entry, count)
    keep(scene, view_layer, layers, log)


def kept(scene: str) -> list[tuple[Entry, int]]:
    """The findings of the scene's last render over all its view layers."""
    merged = DiagnosticsLog()
    for log in list(_kept.get(scene, {}).values()):  # a render may add one meanwhile
        for entry, count in log.counts.items():
            merged.add(entry, count)
    return merged.entries()


def forget() -> None:
    _kept.clear()
