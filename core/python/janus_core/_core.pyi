# SPDX-License-Identifier: GPL-3.0-or-later
"""The native core of Janus. Import janus_core, not this.

Arguments of the wrong kind raise TypeError, data that cannot be rendered SceneError. Lengths are in
metres, angles in radians, colours scene-linear Rec.709; matrices are 4x4 as Blender and NumPy write
them: they multiply column vectors, so the translation is in the last column.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, final

import numpy as np
import numpy.typing as npt

from ._settings import RenderSettings as RenderSettings
from ._transport_session import TransportSession as TransportSession
from ._typed_dicts import Counts, Progress, Stats

__version__: str

class Error(Exception):
    """Base of what the core raises on purpose."""

class SceneError(Error):
    """A description or a setting that cannot be rendered."""

    key: str
    """The item given to SceneBuilder, or "settings"."""
    path: str
    """The offending part of it, such as "triangles[12]"; may be empty."""
    message: str
    """What is wrong, without key and path (which str() has)."""

class IoError(Error):
    """A file that cannot be read or written; the message names it."""

class Cancelled(Error):
    """The work was cancelled."""

@final
class Diagnostic:
    """A recoverable finding; empty strings mean "does not apply"."""

    @property
    def severity(self) -> Literal["INFO", "WARNING", "ERROR"]:
        """How grave it is."""
    @property
    def object(self) -> str:
        """Name of the object."""
    @property
    def material(self) -> str:
        """Name of the material, light or world."""
    @property
    def node(self) -> str:
        """Name of the shader node."""
    @property
    def message(self) -> str:
        """What is not as asked."""

@final
class Scene:
    """A committed scene: immutable, may be shared by sessions and threads."""

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What could not be rendered as asked."""
    @property
    def counts(self) -> Counts:
        """Numbers of meshes, instances, triangles and pieces of curves or points
        (`round`; both with instances), materials, lights (sources
        with a sampling of their own: lamps, emitting objects, the world), and meshes_built: those
        that are not shared with the scene before."""

@final
class CommitTask:
    """A commit on a thread of its own. Dropping it cancels it."""

    def wait(self, seconds: float) -> bool:
        """Waits up to `seconds` for the end, without the GIL; True if it has come."""
    def cancel(self) -> None:
        """Asks it to stop and returns."""
    def scene(self) -> Scene:
        """Waits for the end. Raises SceneError, or Cancelled if it was cancelled."""

@final
class SceneBuilder:
    """Collects a scene description. Keys are the caller's; setting a key again replaces the item.

    All data is copied.
    """

    def __init__(self) -> None: ...
    def set_mesh(
        self,
        key: str,
        *,
        name: str,
        positions: npt.ArrayLike,
        triangles: npt.ArrayLike,
        corner_vertices: npt.ArrayLike | None = None,
        vertex_normals: npt.ArrayLike | None = None,
        corner_normals: npt.ArrayLike | None = None,
        material_indices: npt.ArrayLike | None = None,
        faces: npt.ArrayLike | None = None,
        attributes: Sequence[Mapping[str, Any]] = ...,
        edges: npt.ArrayLike | None = None,
    ) -> None:
        """A mesh in object space.

        positions: float[N, 3]. triangles: int[M, 3], indices of corners. corner_vertices: int[C],
        the position of each corner (None: the corners are the positions). Smooth shading:
        vertex_normals float[N, 3] or corner_normals float[C, 3], need not be unit.
        material_indices: int[M], the material slot of each triangle (None: slot 0).
        faces: int[M], the face of each triangle (None: each is one). attributes: for shaders, each
        with "key" (see set_material()), "domain" (MESH, POINT, CORNER or FACE) and "values",
        float[N] or float[N, 1 to 4]; "pointiness" (which needs "normal") and "random_per_island"
        may come without values, and are computed from edges: int[E, 2], pairs of positions.
        """
    def set_curves(
        self,
        key: str,
        *,
        name: str,
        positions: npt.ArrayLike,
        radii: npt.ArrayLike,
        curves: npt.ArrayLike,
        straight: bool = False,
        material_indices: npt.ArrayLike | None = None,
        attributes: Sequence[Mapping[str, Any]] = ...,
    ) -> None:
        """Hair: tubes along curves, which instances name as they name meshes.

        positions: float[N, 3] and radii: float[N] of the keys, through which curves go smoothly
        (Catmull-Rom) or straight. curves: int[M + 1], where each begins among the keys, and where
        the last one ends. material_indices: int[M] (None: slot 0). attributes: as those of a mesh,
        of points (POINT) and curves (FACE). Tubes are seen from outside alone, as in Cycles.
        """
    def set_points(
        self,
        key: str,
        *,
        name: str,
        positions: npt.ArrayLike,
        radii: npt.ArrayLike,
        attributes: Sequence[Mapping[str, Any]] = ...,
    ) -> None:
        """A point cloud: balls, likewise."""
    def set_material(
        self,
        key: str,
        *,
        name: str,
        graph: Mapping[str, Any],
        sample_emission: bool = True,
        material_index: float = 0.0,
        aovs: Mapping[str, Any] | None = None,
    ) -> list[str]:
        """A surface, as a flattened node tree:

        {"nodes": [{"name", "type", "inputs": {identifier: value}, "properties": {identifier:
        value}}], "surface": {"link": [node, output]} or None, "displacement": likewise, by which it
        is bumped}. The value of an input is None, a number, 3 or 4 numbers, a string, or a link.
        Types and identifiers are Blender's; see node_types(). sample_emission False: what it emits
        is found by chance only. aovs: a tree that ends in OUTPUT_AOV nodes, with the property
        aov_name.

        Returns the keys of the attributes that they read. Of a mesh: "generated", "normal",
        "color:", "uv:NAME", "tangent:NAME", "tangent_sign:NAME" (without a name the active one),
        "attribute:NAME", "pointiness", "random_per_island"; of points "point_radius". Of an
        instance: "object:NAME", "instancer:NAME", "dupli_generated", "dupli_uv", "particle:times"
        (index and age), "particle:lifetime", "particle:size", "particle:location",
        "particle:velocity", "particle:angular_velocity".
        """
    def set_image(
        self,
        key: str,
        *,
        name: str,
        pixels: npt.ArrayLike,
        srgb: bool = False,
        associated: bool = False,
    ) -> None:
        """A picture for texture nodes, which name it by their property "image": this key; or, with
        a property "tiles" (numbers of UDIM tiles), by this key, ":" and the tile.

        pixels: float[H, W, 3 or 4], the bottom row first, scene-linear Rec.709; with srgb encoded
        as sRGB, and decoded after interpolation, as in Cycles. associated: colours have been
        multiplied by alpha.
        """
    def set_instance(
        self,
        key: str,
        *,
        name: str,
        mesh: str,
        transform: npt.ArrayLike,
        materials: Sequence[str | None] = ...,
        visible_camera: bool = True,
        visible_diffuse: bool = True,
        visible_glossy: bool = True,
        visible_transmission: bool = True,
        visible_shadow: bool = True,
        holdout: bool = False,
        color: Sequence[float] = (1.0, 1.0, 1.0, 1.0),
        object_index: float = 0.0,
        random: float = 0.0,
        attributes: Mapping[str, Sequence[float]] = ...,
        light_group: str = "",
        asset: str = "",
        receiver_set: int = -1,
        blocker_set: int = -1,
        unlit_by: Sequence[int] = (),
        lets_pass: Sequence[int] = (),
        shadow_catcher: bool = False,
    ) -> None:
        """Places the mesh with the key `mesh` in the world.

        transform: float[4, 4], object to world. materials: a key for each slot, or None for the
        default surface. visible_*: the rays that meet it, as in Blender. holdout: it
        leaves a hole where the camera sees it. attributes: four numbers under each key that
        set_material() gives of an instance. light_group: of what it emits, for expressions.
        asset: the name of what it is a part of, for Cryptomatte; empty: its own.
        Light linking: receiver_set and blocker_set are numbers of the sets of lights that it is in
        as a light, below 63 and below 24, which shine on some things only, and which only some
        block (-1: none); unlit_by and lets_pass are the sets that do not shine on it, and that it
        is not in the way of. shadow_catcher: it is part of the footage that the picture is laid
        over, which shows only what is done to its light.
        """
    def set_light(
        self,
        key: str,
        *,
        name: str,
        type: Literal["POINT", "SPOT", "SUN", "AREA"],
        transform: npt.ArrayLike,
        color: Sequence[float] = (1.0, 1.0, 1.0),
        energy: float = 10.0,
        radius: float = 0.0,
        soft_falloff: bool = True,
        shape: Literal["SQUARE", "RECTANGLE", "DISK", "ELLIPSE"] = "SQUARE",
        size: float = 0.25,
        size_y: float = 0.25,
        spread: float = ...,
        spot_size: float = ...,
        spot_blend: float = 0.15,
        spot_square: bool = False,
        angle: float = 0.0,
        normalize: bool = True,
        exposure: float = 0.0,
        visible_camera: bool = True,
        visible_diffuse: bool = True,
        visible_glossy: bool = True,
        visible_transmission: bool = True,
        cast_shadow: bool = True,
        max_bounces: int = 1024,
        graph: Mapping[str, Any] | None = None,
        light_group: str = "",
        receiver_set: int = -1,
        blocker_set: int = -1,
        lights_catchers: bool = True,
    ) -> None:
        """A light object, which shines along its -z.

        transform: float[4, 4]. energy: watts (SUN: W/m^2), times 2**exposure; with normalize False
        it does not spread over the light's surface. radius: POINT, SPOT. size, size_y: AREA, edges
        or diameters before the transform. spread: AREA, full angle. angle: SUN, full angle.
        spot_size: full angle. visible_*: the camera, and the bounces, that see it. cast_shadow
        False: its light passes everything. max_bounces: of the paths that it lights. graph: the
        light's own node tree, as for set_material.
        """
    def set_world(
        self,
        *,
        name: str,
        graph: Mapping[str, Any] | None,
        visible_camera: bool = True,
        visible_diffuse: bool = True,
        visible_glossy: bool = True,
        visible_transmission: bool = True,
        light_group: str = "",
        aovs: Mapping[str, Any] | None = None,
    ) -> None:
        """The background, as for set_material; graph None: black.

        A TEX_ENVIRONMENT node with a lat-long image may feed the Background's colour, its vector
        unlinked or from TEX_COORD (Generated), directly or by way of a MAPPING that only turns.
        """
    def set_camera(
        self,
        *,
        name: str,
        type: Literal[
            "PERSP",
            "ORTHO",
            "EQUIRECTANGULAR",
            "FISHEYE_EQUIDISTANT",
            "FISHEYE_EQUISOLID",
            "FISHEYE_LENS_POLYNOMIAL",
            "MIRRORBALL",
            "EQUIANGULAR_CUBEMAP_FACE",
            "CENTRAL_CYLINDRICAL",
        ] = "PERSP",
        transform: npt.ArrayLike,
        window: Sequence[float],
        clip_start: float = 0.1,
        clip_end: float = 1000.0,
        aperture_radius: float = 0.0,
        focus_distance: float = 10.0,
        aperture_blades: int = 0,
        aperture_rotation: float = 0.0,
        aperture_ratio: float = 1.0,
        pixel_size: float = 0.0,
        shift: Sequence[float] = (0.0, 0.0),
        fisheye_fov: float = ...,
        fisheye_lens: float = ...,
        fisheye_polynomial: Sequence[float] = ...,
    ) -> None:
        """A camera that looks along its -z, with +y up.

        transform: float[4, 4], camera to world. window: left, right, bottom, top of the full frame;
        PERSP: on the plane at distance 1; ORTHO: metres; EQUIRECTANGULAR: longitudes and latitudes
        in radians; FISHEYE_EQUIDISTANT, EQUIANGULAR_CUBEMAP_FACE: angles from the view axis in
        radians; FISHEYE_EQUISOLID, FISHEYE_LENS_POLYNOMIAL: millimetres on the sensor; MIRRORBALL:
        radii of its disk; CENTRAL_CYLINDRICAL: longitudes, and heights on a cylinder of radius 1.
        clip_start, clip_end, focus_distance: along the view axis, or along the ray of a panorama.
        aperture_radius: metres; 0: everything is in focus. aperture_blades: corners of the
        aperture; below 3: round. aperture_ratio: height to width.

        Of panoramas: shift, that the window has had, in widths and heights of it. Of fisheyes:
        fisheye_fov, radians from rim to rim; fisheye_lens, the focal length of an equisolid one in
        millimetres; fisheye_polynomial, K0 to K4, minus the angle from the view axis in radians by
        millimetres on the sensor.
        """
    def set_mesh_motion(
        self, key: str, *, positions: npt.ArrayLike, normals: npt.ArrayLike | None = None
    ) -> None:
        """How a mesh, curves or points that have been set change while the shutter is open.

        positions: float[K, N, 3] at K even times from opening to closing. normals: float[K, N or C,
        3], of vertices or corners, whichever it has; None: it has none.
        """
    def set_instance_motion(self, key: str, *, transforms: npt.ArrayLike) -> None:
        """Where an instance that has been set is at K such times: float[K, 4, 4]."""
    def set_camera_motion(
        self, *, transforms: npt.ArrayLike, windows: Sequence[Sequence[float]]
    ) -> None:
        """Where the camera is at K such times, float[K, 4, 4], and its window, float[K, 4]."""
    def set_shutter(self, openness: Sequence[float]) -> None:
        """How open the shutter is at even times; without, all times count alike."""
    def remove(self, key: str) -> None:
        """Forgets what has this key; unknown keys are ignored."""
    def commit(self, poll: Callable[[], object] | None = None) -> Scene:
        """Builds the immutable scene without holding the GIL.

        poll() is called about every 50 ms in this thread; True cancels. Raises SceneError,
        Cancelled, or what poll raised. The builder stays as it is and can be committed again:
        meshes that were set before the last commit, with their hierarchies for rays, are shared
        with its Scene, if that is still in use.
        """
    def start_commit(self) -> CommitTask:
        """The same on a thread of its own, without poll. The builder may be changed meanwhile."""

@final
class RenderSession:
    """One render, on threads of its own that never run Python. Dropping it cancels it.

    Methods may be called from any thread.
    """

    def __init__(self, scene: Scene, settings: RenderSettings) -> None: ...
    def start(self) -> None:
        """Starts the render and returns. Once only."""
    def wait(self, seconds: float) -> bool:
        """Waits up to `seconds` for the end, without the GIL; True if the render has ended."""
    def progress(self) -> Progress:
        """samples, target_samples, seconds (since start), remaining (seconds, None before the
        first pass) and state."""
    def cancel(self) -> None:
        """Asks the render to stop and returns. Whole passes are kept."""
    def snapshot(self, name: str = "Combined") -> npt.NDArray[np.float32]:
        """The mean of the whole passes so far: float32[height, width, 4] of the crop, scene linear,
        premultiplied alpha, bottom row first. Other passes than Combined have three channels, or
        what they need. A new array each time. Raises ValueError for a name that is not in passes().
        """
    def passes(self) -> list[str]:
        """The names that snapshot() knows: Combined, the expressions', Cycles' passes of light, and
        the strategies': 's1 t2 weighted', 's1 t2 alone' (without weight), 'longer weighted';
        then those of data, CryptoObject00 and so on among them."""
    def manifest(self, kind: Literal["Object", "Material", "Asset"]) -> dict[str, str]:
        """The names that Cryptomatte knows, with their hashes."""
    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What of the settings has no effect in this scene."""
    def finish(self) -> None:
        """Waits for the end and raises what went wrong on the render threads, if anything."""
    def stats(self) -> Stats:
        """Whole passes (samples), seconds of rendering, paths and rays by kind, joins (how far they
        came before they were given up), light_vertices (kept in the cache) and light_cache_bytes
        (its largest size), dropped (values that were not finite), weight_error (with check_weights:
        the largest difference from the definition)."""

def check_expression(text: str) -> str:
    """What is wrong with a light path expression, for the user; empty: nothing."""

def cryptomatte_hash(name: str) -> str:
    """The hash of a name in Cryptomatte, eight hexadecimal digits."""

def check_strategies(text: str) -> str:
    """What is wrong with a choice of strategies, for the user; empty: nothing."""

def build_info() -> dict[str, Any]:
    """Versions of the core, of Embree and of the tools that it was built with."""

def node_types() -> list[dict[str, Any]]:
    """The shader nodes that the core knows: type (Blender's node.type), inputs (dicts with
    identifier, type, default of three numbers) and outputs (identifiers)."""
