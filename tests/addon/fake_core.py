# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands in for janus_core: records what is built, "renders" a constant colour."""

from types import SimpleNamespace

import numpy as np

# Of passes that do not have three.
ONE = ("Depth", "Mist", "IndexOB", "IndexMA", "Denoising Depth", "Debug Sample Count")
CHANNELS = dict.fromkeys(ONE, 1) | {"Vector": 4}


class Recorder:
    """Has the methods of SceneBuilder and keeps their arguments, arrays copied. Nothing may be set
    twice between two commits."""

    def __init__(self, diagnostics=()):
        self.fresh = set()  # (method, key) since the last commit
        self.meshes, self.materials, self.instances, self.lights = {}, {}, {}, {}
        self.images = {}
        self.attributes = {}  # name of a material -> keys of what it reads
        self.world = self.camera = self.camera_motion = self.shutter = None
        self.mesh_motion, self.instance_motion = {}, {}
        self.diagnostics = list(diagnostics)

    @staticmethod
    def _copy(arguments):
        return {k: v.copy() if isinstance(v, np.ndarray) else v for k, v in arguments.items()}

    def _note(self, method, key):
        assert (method, key) not in self.fresh
        self.fresh.add((method, key))

    def set_mesh(self, key, **arguments):
        self._note("mesh", key)
        self.mesh_motion.pop(key, None)
        self.meshes[key] = self._copy(arguments)

    def set_curves(self, key, **arguments):
        self.set_mesh(key, **arguments)

    def set_points(self, key, **arguments):
        self.set_mesh(key, **arguments)

    def set_material(self, key, **arguments):
        self._note("material", key)
        self.materials[key] = arguments
        return self.attributes.get(arguments["name"], [])

    def set_image(self, key, **arguments):
        self._note("image", key)
        self.images[key] = self._copy(arguments)

    def set_instance(self, key, **arguments):
        self._note("instance", key)
        self.instance_motion.pop(key, None)
        self.instances[key] = self._copy(arguments)

    def set_light(self, key, **arguments):
        self._note("light", key)
        self.lights[key] = self._copy(arguments)

    def set_world(self, **arguments):
        self.world = arguments

    def set_camera(self, **arguments):
        self.camera = self._copy(arguments)
        self.camera_motion = self.shutter = None

    def set_mesh_motion(self, key, **arguments):
        assert ("mesh", key) in self.fresh
        self.mesh_motion[key] = self._copy(arguments)

    def set_instance_motion(self, key, transforms):
        assert key in self.instances
        self.instance_motion[key] = transforms

    def set_camera_motion(self, **arguments):
        self.camera_motion = arguments

    def set_shutter(self, openness):
        self.shutter = openness

    def remove(self, key):
        for items in (self.meshes, self.materials, self.images, self.instances, self.lights):
            items.pop(key, None)
        self.mesh_motion.pop(key, None)
        self.instance_motion.pop(key, None)

    def commit(self, poll=None):
        self.fresh.clear()
        return SimpleNamespace(
            diagnostics=self.diagnostics, counts={"instances": len(self.instances)}
        )

    # What tests ask for.

    def by_name(self, kind="instances"):
        return {item["name"]: item for item in getattr(self, kind).values()}

    def motion_of(self, object_name):
        """Transforms of the object at the times of the shutter; None: it stands still."""
        found = [key for key, item in self.instances.items() if item["name"] == object_name]
        return self.instance_motion.get(found[0])

    def mesh_of(self, object_name):
        return self.meshes[self.by_name()[object_name]["mesh"]]

    def materials_of(self, object_name):
        keys = self.by_name()[object_name]["materials"]
        return [key and self.materials[key]["name"] for key in keys]


class FakeCore:
    """The module janus_core. Set `script` to decide what a session does at each wait()."""

    __version__ = "0.1.9"

    class Cancelled(RuntimeError):
        pass

    class SceneError(RuntimeError):
        pass

    def __init__(self):
        self.builder = None
        self.reads = {}  # name of a material -> keys of what it reads
        self.settings = None
        self.sessions = []
        self.diagnostics = []
        self.color = (0.25, 0.5, 0.75, 1.0)
        self.script = lambda session: None  # may raise, cancel, count up session.samples

    @staticmethod
    def check_expression(text):
        """Knows nothing of the grammar, but the commonest mistake."""
        return "" if text.startswith(("L", "B")) else f"'{text}' does not begin with a light"

    @staticmethod
    def check_strategies(text):
        pairs = text.split()
        return "" if all("," in pair for pair in pairs) else f"'{text}' is no list of pairs s,t"

    @staticmethod
    def cryptomatte_hash(name):
        return f"{len(name):08x}"

    def SceneBuilder(self):  # noqa: N802
        self.builder = Recorder(self.diagnostics)
        self.builder.attributes.update(self.reads)
        return self.builder

    def RenderSettings(self, **settings):  # noqa: N802
        self.settings = SimpleNamespace(**settings)
        return self.settings

    def RenderSession(self, scene, settings):  # noqa: N802
        self.sessions.append(FakeSession(self, settings))
        return self.sessions[-1]


class FakeSession:
    """Finishes one sample with each wait()."""

    diagnostics: tuple = ()

    def __init__(self, core, settings):
        self.core, self.settings = core, settings
        self.samples, self.cancelled, self.snapshots = 0, False, 0

    def start(self):
        pass

    def wait(self, seconds):
        if self.cancelled:
            return True
        self.core.script(self)
        self.samples += 1
        return self.samples >= self.settings.samples

    def cancel(self):
        self.cancelled = True

    def finish(self):
        pass

    def progress(self):
        return {
            "samples": self.samples,
            "target_samples": self.settings.samples,
            "seconds": 0.1 * self.samples,
            "remaining": None,
            "state": "rendering",
        }

    def passes(self):
        settings = self.settings
        names = ["Combined", *(name for name, _ in settings.expressions), *settings.light_passes]
        for edges in range(1, settings.strategy_images + 1):
            for s in range(edges + 1):
                names += [f"s{s} t{edges + 1 - s} {kind}" for kind in ("weighted", "alone")]
        names += ["longer weighted"] * (settings.strategy_images > 0)
        names += settings.data_passes
        for kind in settings.cryptomatte:
            names += [f"Crypto{kind}{level:02d}" for level in range(settings.cryptomatte_levels)]
        return names + [f"AOV {name}" for name, _ in settings.aovs]

    def manifest(self, kind):
        return {f"any {kind}": "01234567"}

    def snapshot(self, name):
        """Combined has the colour of the core, pass number n (from 1) has n in each channel."""
        number = self.passes().index(name)
        self.snapshots += 1
        x0, y0, x1, y1 = self.settings.crop or (0, 0, self.settings.width, self.settings.height)
        channels = 4 if not number or name.startswith("Crypto") else CHANNELS.get(name, 3)
        kinds = {f"AOV {aov}": 4 if kind == "COLOR" else 1 for aov, kind in self.settings.aovs}
        channels = kinds.get(name, channels)
        pixels = np.empty((y1 - y0, x1 - x0, channels), dtype=np.float32)
        pixels[:] = (number or self.core.color) if self.samples else 0.0
        return pixels

    def stats(self):
        return {"samples": self.samples, "seconds": 0.1 * self.samples}
