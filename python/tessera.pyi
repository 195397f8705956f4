"""Tessera renders scenes with many lights by several techniques, and checks that their pictures agree."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypedDict

import numpy
import numpy.typing
from typing_extensions import Unpack

__version__: str
__commit__: str

_Path = str | os.PathLike[str]
_Point = Sequence[float]
_Progress = Callable[[int, int], object]

class InputError(ValueError):
    """What was given cannot be used: a missing or broken file, an unknown name, a value out of range."""

class Keywords(TypedDict, total=False):
    """The keywords that functions take besides their own: options of the load, then settings(). None says nothing. For
    type checkers alone: the module has no such name."""

    lights: int | None
    default_light: bool | None
    environment: _Path | None
    background: _Point | None
    clip: str | int | None
    hook: Mapping[str, float] | None
    memory_limit: str | int | None
    variant: str | None
    light_units: str | None
    obj_colours: str | None
    strict: bool | None
    default_camera: bool | None
    eye: _Point | None
    target: _Point | None
    up: _Point | None
    fov: float | None
    half_height: float | None
    near: float | None
    far: float | None

    technique: str | None
    layout: str | None
    culling: str | None
    tile: int | str | None
    cull_on: str | None
    cull_normals: str | None
    light_on: str | None
    size: tuple[int, int] | str | None
    samples: int | str | None
    camera: str | int | None
    time: float | str | None
    range_tolerance: float | str | None
    area_lights: str | None
    area_samples: int | str | None
    view: str | int | None
    solo: int | str | None
    environment_light: str | None
    environment_samples: int | str | None
    environment_compensation: bool | str | None
    environment_rotation: float | str | None
    environment_intensity: float | str | None
    backdrop: str | None
    refraction: str | None
    glass_depth: int | str | None
    shadows: str | int | None
    shadow_filter: str | None
    shadow_terminator: str | None
    shadow_samples: int | str | None
    shadow_width: int | str | None
    shadow_resolution: int | str | None
    shadow_budget: float | str | None
    shadow_cascades: int | str | None
    subsurface: str | None
    diffusion_texels: int | str | None
    diffusion_gaussians: int | str | None
    diffusion_half: bool | str | None
    specular: bool | str | None
    filter: str | None
    space: str | None
    prune: bool | str | None
    exposure: float | str | None
    tonemap: str | None

class Scene:
    """A scene that load() has read."""

    @property
    def name(self) -> str: ...
    @property
    def triangles(self) -> int: ...
    @property
    def lights(self) -> int: ...
    @property
    def materials(self) -> int: ...
    @property
    def cameras(self) -> list[str]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def files(self) -> list[str]: ...

class Picture:
    """A picture that render() has made. Rows run from the top."""

    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def scene(self) -> str: ...
    @property
    def technique(self) -> str: ...
    @property
    def view(self) -> str: ...
    @property
    def rgba(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def rgb(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def alpha(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def display(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    def png(self) -> bytes: ...
    def save(self, path: _Path) -> None: ...
    def _repr_png_(self) -> bytes | None: ...
    def __array__(
        self, dtype: numpy.typing.DTypeLike | None = None, copy: bool | None = None
    ) -> numpy.typing.NDArray[Any]: ...

def load(source: _Path, *, progress: _Progress | None = None, **keywords: Unpack[Keywords]) -> Scene: ...
def render(scene: Scene | _Path, *, progress: _Progress | None = None, **keywords: Unpack[Keywords]) -> Picture: ...
def compare(
    scene: Scene | _Path,
    *,
    techniques: str | Sequence[str] | None = None,
    against: _Path = "forward",
    progress: _Progress | None = None,
    **keywords: Unpack[Keywords],
) -> dict[str, Any]: ...
def plan(
    scene: Scene | _Path,
    *,
    also: str | int | Iterable[str | int] = (),
    measure: bool = False,
    **keywords: Unpack[Keywords],
) -> dict[str, Any]: ...
def bench(
    scenes: _Path | Sequence[_Path],
    *,
    matrix: Mapping[str, Sequence[Any]] | None = None,
    against: str | None = None,
    frames: int | None = None,
    output: _Path | None = None,
    resume: bool = False,
    progress: _Progress | None = None,
    **keywords: Unpack[Keywords],
) -> dict[str, Any]: ...
def scenes() -> list[dict[str, str]]: ...
def techniques() -> list[str]: ...
def views() -> list[dict[str, str]]: ...
def settings() -> list[dict[str, Any]]: ...
def load_options() -> list[dict[str, str]]: ...
def use_context(kind: str) -> None: ...
