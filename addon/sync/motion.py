# SPDX-License-Identifier: GPL-3.0-or-later
"""What moves while the shutter is open: the scene is looked at again at other times."""

from dataclasses import dataclass

import numpy as np

from .camera import window, without_scale
from .curves import HAIR, curves_form, particle_form
from .instance import made_by_nodes, owner_of
from .mesh import mesh_form

PARTS = ("", HAIR)  # of an object that instances show
MOST_STEPS = 7  # 129 times, as in Cycles
CURVE_POINTS = 256


@dataclass(frozen=True)
class Shutter:
    """Times in frames."""

    center: float  # when half of the time is over
    duration: float  # from opening to closing
    blurs: bool  # False: neighbouring frames are looked at for the pass Vector

    def time(self, share: float) -> float:
        """`share`: 0 when it opens, 1 when it closes."""
        return self.center + (share - 0.5) * self.duration


def shutter(scene, layer) -> Shutter | None:
    """Of a render; None: nothing needs to be known of other times."""
    render = scene.render
    now = scene.frame_current + scene.frame_subframe
    if render.use_motion_blur and layer.use_motion_blur:
        delay = {"START": 0.5, "CENTER": 0.0, "END": -0.5}[render.motion_blur_position]
        duration = render.motion_blur_shutter
        return Shutter(now + delay * duration, duration, True) if duration > 0.0 else None
    return Shutter(now, 2.0, False) if layer.use_pass_vector else None


def openness(render) -> np.ndarray | None:
    """How open the shutter is at even times; None: equally at all times."""
    mapping = render.motion_blur_shutter_curve
    mapping.initialize()
    curve = mapping.curves[0]
    times = (np.arange(CURVE_POINTS) + 0.5) / CURVE_POINTS
    values = np.array([max(mapping.evaluate(curve, x), 0.0) for x in times])
    return None if np.ptp(values) < 1e-6 or values.max() <= 0.0 else values


def keys_of(obj, owner, found: Shutter) -> int:
    """At how many times an object is looked at; 1: it stands still. Cycles' settings: those of who
    instances it count, too."""
    if not found.blurs:
        return 3
    of_cycles = [getattr(item, "cycles", None) for item in (obj, owner)]
    if not all(getattr(settings, "use_motion_blur", True) for settings in of_cycles):
        return 1
    steps = max(getattr(settings, "motion_steps", 1) for settings in of_cycles)
    return (1 << min(max(steps, 1), MOST_STEPS)) + 1


def deforms(instance, owner, found: Shutter, scene) -> bool:
    """Can the form of what is shown change? A look at each mesh would take long."""
    obj = instance.object
    if found.blurs and not all(
        getattr(getattr(item, "cycles", None), "use_deform_motion", True) for item in (obj, owner)
    ):
        return False
    if made_by_nodes(instance):
        return True  # they may do anything
    real = instance.instance_object if instance.is_instance else obj
    return real.original.is_deform_modified(scene, "RENDER")


@dataclass
class _Object:
    key: str
    transforms: list  # one for each time; None: not seen


@dataclass
class _Form:
    key: str  # of the mesh
    name: str  # of an object that shows it
    attributes: frozenset
    forms: list  # (positions, normals) for each time; None: not seen


class MotionSync:
    """Notes what the sync of the scene places, and then looks where it is at other times."""

    def __init__(self, found: Shutter, log, viewport: bool):
        self._shutter = found
        self._viewport = viewport
        self._log = log
        self._objects = {}  # who shows it, and which of its instances -> _Object
        self._forms = {}  # the same, of one for each mesh that may change -> _Form
        self._meshes = set()  # keys of all that have been seen
        self.deformed = set()  # and of those that were sent with motion

    def saw(self, instance, owner, key: str, mesh: str, attributes, part: str, depsgraph) -> None:
        """An instance has been placed; `part`: of its object, "" the shape itself."""
        keys = keys_of(instance.object, owner, self._shutter)
        if keys < 2:
            return
        identity = (*_identity(instance, owner), part)
        self._objects[identity] = _Object(key, [None] * keys)
        if mesh not in self._meshes and deforms(instance, owner, self._shutter, depsgraph.scene):
            self._forms[identity] = _Form(mesh, instance.object.name, attributes, [None] * keys)
        self._meshes.add(mesh)

    def run(self, builder, depsgraph, frame_window, set_frame, poll) -> None:
        """Sends how all that moves does. set_frame(time) takes Blender there; where it is left is
        the caller's business. `frame_window`: of the camera at the centre.
        """
        camera = _camera(depsgraph)
        camera_keys = keys_of(camera, camera, self._shutter)
        counts = [camera_keys, *(len(item.transforms) for item in self._objects.values())]
        most = max(counts)
        if most < 2:
            return
        poses = []
        for i in range(most):
            set_frame(self._shutter.time(i / (most - 1)))
            if camera_keys > 1 and i % ((most - 1) // (camera_keys - 1)) == 0:
                poses.append(_pose(depsgraph, frame_window))
            self._look(depsgraph, i, most, poll)
        self._send(builder, poses)
        if self._shutter.blurs:
            curve = openness(depsgraph.scene_eval.render)
            if curve is not None:
                builder.set_shutter(curve)

    def _look(self, depsgraph, number: int, most: int, poll) -> None:
        for instance in depsgraph.object_instances:
            poll()
            if instance.object.type not in ("MESH", "CURVES", "POINTCLOUD"):
                continue
            owner = owner_of(instance)
            shown = _identity(instance, owner)
            for part in PARTS:
                identity = (*shown, part)
                found = self._objects.get(identity)
                if found is None or number % (stride := (most - 1) // (len(found.transforms) - 1)):
                    continue
                matrix = np.array(instance.matrix_world, dtype=np.float64)
                found.transforms[number // stride] = matrix
                if known := self._forms.get(identity):
                    known.forms[number // stride] = self._read(
                        instance.object, known.attributes, part
                    )

    def _read(self, obj, attributes, part: str):
        if part:
            return particle_form(obj, self._viewport)
        if obj.type != "MESH":
            return curves_form(obj.data)
        try:
            return mesh_form(obj.to_mesh(), attributes)
        finally:
            obj.to_mesh_clear()

    def _send(self, builder, poses) -> None:
        for item in self._objects.values():
            # Who is not there at some time was not made yet, or is no more: it stands still.
            seen = all(matrix is not None for matrix in item.transforms)
            if seen and _differ(item.transforms):
                builder.set_instance_motion(item.key, transforms=np.stack(item.transforms))
        for form in self._forms.values():
            self._send_form(builder, form)
        if poses and (
            _differ([matrix for matrix, _ in poses]) or _differ([side for _, side in poses])
        ):
            builder.set_camera_motion(
                transforms=np.stack([matrix for matrix, _ in poses]),
                windows=[side for _, side in poses],
            )

    def _send_form(self, builder, form: _Form) -> None:
        if any(found is None for found in form.forms):
            return
        positions = [found[0] for found in form.forms]
        normals = [found[1] for found in form.forms]
        if len({(len(p), None if n is None else len(n)) for p, n in form.forms}) > 1:
            self._log.warning(
                "its number of vertices changes while the shutter is open: it is rendered without "
                "deformation",
                object=form.name,
            )
        elif _differ(positions):
            self.deformed.add(form.key)
            builder.set_mesh_motion(
                form.key,
                positions=np.stack(positions),
                normals=None if normals[0] is None else np.stack(normals),
            )


def _identity(instance, owner):
    number = tuple(instance.persistent_id) if instance.is_instance else ()
    return instance.object.original.as_pointer(), owner.original.as_pointer(), number


def _camera(depsgraph):
    return depsgraph.scene_eval.camera.evaluated_get(depsgraph)


def _pose(depsgraph, frame_window):
    camera = _camera(depsgraph)
    if camera.data.type != "PANO":
        frame_window = window(camera, depsgraph, depsgraph.scene_eval.render)
    return without_scale(camera.matrix_world), frame_window


def _differ(values) -> bool:
    return any(not np.array_equal(values[0], value) for value in values[1:])
