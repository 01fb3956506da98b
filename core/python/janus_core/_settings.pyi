# SPDX-License-Identifier: GPL-3.0-or-later
"""Part of _core.pyi: the settings of a render."""

from collections.abc import Sequence
from typing import Any, Literal, final

@final
class RenderSettings:
    """What to render of a scene: immutable, checked when made (SceneError names the setting)."""

    def __init__(
        self,
        *,
        width: int = 640,
        height: int = 360,
        crop: Sequence[int] | None = None,
        samples: int = 64,
        noise_threshold: float = 0.0,
        min_samples: int = 0,
        seconds: float = 0.0,
        seed: int = 0,
        threads: int = 0,
        max_bounces: int = 12,
        max_diffuse_bounces: int = 1024,
        max_glossy_bounces: int = 1024,
        max_transmission_bounces: int = 1024,
        transparent_max_bounces: int = 8,
        clamp_direct: float = 0.0,
        clamp_indirect: float = 0.0,
        integrator: Literal["bdpt", "pt", "lt"] = "bdpt",
        filter: Literal["BLACKMAN_HARRIS", "GAUSSIAN", "BOX"] = "BLACKMAN_HARRIS",
        filter_width: float = 1.5,
        light_paths: float = 1.0,
        connections: float = 1.0,
        merge_radius: float = 0.0,
        adaptive_counts: bool = False,
        heuristic: Literal["BALANCE", "POWER", "NONE"] = "BALANCE",
        motion_blur: bool = True,
        film_exposure: float = 1.0,
        film_transparent: bool = False,
        film_transparent_glass: bool = False,
        film_transparent_roughness: float = 0.1,
        roulette: bool = True,
        check_weights: bool = False,
        next_event: bool = True,
        connection_mode: Literal["CACHE", "CLASSIC"] = "CACHE",
        strategies: str = "",
        expressions: Sequence[tuple[str, str]] = ...,
        light_passes: Sequence[str] = ...,
        strategy_images: int = 0,
        shadow_catcher: bool = False,
        data_passes: Sequence[str] = ...,
        cryptomatte: Sequence[Literal["Object", "Material", "Asset"]] = ...,
        cryptomatte_levels: int = 3,
        pass_alpha_threshold: float = 0.5,
        mist: Sequence[float] = (5.0, 25.0, 2.0),
        occlusion_distance: float = 0.0,
        aovs: Sequence[tuple[str, Literal["COLOR", "VALUE"]]] = ...,
    ) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """The keyword arguments that make these settings."""
    def __eq__(self, other: object, /) -> bool: ...
    @property
    def width(self) -> int:
        """Of the full frame, pixels."""
    @property
    def height(self) -> int:
        """Of the full frame, pixels."""
    @property
    def crop(self) -> tuple[int, int, int, int] | None:
        """x0, y0, x1, y1 of the part to render, pixels from the bottom left; None: all."""
    @property
    def noise_threshold(self) -> float:
        """Pixels with less noise, as Cycles measures it, stop early (a small bias); 0: none."""
    @property
    def min_samples(self) -> int:
        """Samples that a pixel gets before it may stop; 0: a number by the threshold."""
    @property
    def samples(self) -> int:
        """Per pixel; one pass of the whole picture each."""
    @property
    def seconds(self) -> float:
        """Time limit of the render; 0: none. The first pass always completes."""
    @property
    def seed(self) -> int:
        """The same scene, settings and seed give the same picture, bit for bit."""
    @property
    def threads(self) -> int:
        """0: one per hardware thread. Does not change the picture."""
    @property
    def max_bounces(self) -> int:
        """As in Cycles: 0 is direct light only."""
    @property
    def max_diffuse_bounces(self) -> int:
        """Of them by diffuse reflection, as Cycles counts; the one next to the light is none."""
    @property
    def max_glossy_bounces(self) -> int:
        """By glossy reflection, mirrors included."""
    @property
    def max_transmission_bounces(self) -> int:
        """By transmission: glass, refraction, translucency."""
    @property
    def transparent_max_bounces(self) -> int:
        """How many surfaces a path may pass by alpha or transparency."""
    @property
    def clamp_direct(self) -> float:
        """The most that a contribution of direct light adds to a sample; 0: no limit."""
    @property
    def clamp_indirect(self) -> float:
        """Likewise of indirect light. A bias: caustics lose light first."""
    @property
    def integrator(self) -> Literal["bdpt", "pt", "lt"]:
        """Bidirectional path tracing, path tracing, light tracing."""
    @property
    def filter(self) -> Literal["BLACKMAN_HARRIS", "GAUSSIAN", "BOX"]:
        """Shape of the pixel filter."""
    @property
    def filter_width(self) -> float:
        """Pixels."""
    @property
    def light_paths(self) -> float:
        """Light paths per pixel and pass."""
    @property
    def connections(self) -> float:
        """Connections per vertex of a camera path."""
    @property
    def merge_radius(self) -> float:
        """Bidirectional: how far apart vertices may be to be merged; 0: not at all."""
    @property
    def adaptive_counts(self) -> bool:
        """Bidirectional: starts with the two counts, then takes what is most efficient."""
    @property
    def heuristic(self) -> Literal["BALANCE", "POWER"]:
        """How the techniques are weighted."""
    @property
    def motion_blur(self) -> bool:
        """Is what moves while the shutter is open blurred?"""
    @property
    def film_exposure(self) -> float:
        """A factor of the finished picture's colour."""
    @property
    def film_transparent(self) -> bool:
        """Whether the world is left out of the picture, with alpha 0 there."""
    @property
    def film_transparent_glass(self) -> bool:
        """On a transparent film: whether it is left out behind clear glass, too."""
    @property
    def film_transparent_roughness(self) -> float:
        """The largest roughness of glass that counts as clear."""
    @property
    def roulette(self) -> bool:
        """False traces every path and every shadow ray to its end; slow, for tests."""
    @property
    def check_weights(self) -> bool:
        """Debug: compares the MIS weights of sampled paths with their definition; slow."""
    @property
    def next_event(self) -> bool:
        """False leaves next event estimation out: pt finds lights by hitting them alone, and lt a
        camera with a lens (t=0)."""
    @property
    def connection_mode(self) -> str:
        """bdpt: CACHE, light vertices for all pixels, or CLASSIC, a light path for each camera
        path, of which every vertex is joined with every vertex."""
    @property
    def strategies(self) -> str:
        """With the heuristic NONE, the strategies that render, as '0,* 2,3'; empty: all."""
    @property
    def expressions(self) -> list[tuple[str, str]]:
        """Name and light path expression of each additional pass."""
    @property
    def light_passes(self) -> list[str]:
        """Cycles' passes of light, by Blender's names: DiffDir, DiffInd, DiffCol, the same of Gloss
        and Trans, Emit, Env."""
    @property
    def data_passes(self) -> list[str]:
        """Depth, Position, IndexOB, IndexMA: of the first sample of a pixel; Normal, UV, Mist,
        Denoising Albedo, Denoising Normal, Denoising Depth: means; Debug Sample Count."""
    @property
    def cryptomatte(self) -> list[str]:
        """What Cryptomatte passes tell apart: Object, Material, Asset."""
    @property
    def cryptomatte_levels(self) -> int:
        """Of each, pictures of two ids: CryptoObject00 and so on."""
    @property
    def pass_alpha_threshold(self) -> float:
        """Surfaces with less alpha are looked through by Normal and UV."""
    @property
    def occlusion_distance(self) -> float:
        """How far away, in metres, surroundings occlude in the pass AO; 0: however far."""
    @property
    def aovs(self) -> list[tuple[str, str]]:
        """Name and type, COLOR or VALUE, of what AOV Output nodes write; the picture is 'AOV '
        and the name."""
    @property
    def mist(self) -> tuple[float, float, float]:
        """Start and depth in metres, and the power of the falloff."""
    @property
    def shadow_catcher(self) -> bool:
        """Is there a pass of what shadow catchers show? It is not in the picture then."""
    @property
    def strategy_images(self) -> int:
        """bdpt: each strategy of paths of up to so many edges has passes; 0: none."""
