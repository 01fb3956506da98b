# SPDX-License-Identifier: GPL-3.0-or-later
"""LuxCore's bidirectional path tracer as a service: `_luxcore.py CAPTURE THREADS`.

Its roulette is off: with it, the weights of a path do not sum to one, and the picture is too
bright. It has no cap on the whole length of a path, only one for each side, and for light paths
and camera paths that are shorter than that it misses no technique; caps of MARGIN more than the
bounces leave no darkening to be seen.
"""

import sys
import time

import _plain
import numpy as np
import pyluxcore
from _peer import load, serve

MARGIN = 4


def main(path: str, threads: int) -> None:
    scene = load(path)
    pyluxcore.Init(lambda _: None)
    lux = _translate(scene)

    def render(seconds: float, seed: int):
        depth = scene.max_bounces + MARGIN
        session = pyluxcore.RenderSession(
            pyluxcore.RenderConfig(
                _properties(
                    {
                        "renderengine.type": "BIDIRCPU",
                        "renderengine.seed": seed + 1,
                        "native.threads.count": threads,
                        "path.maxdepth": depth,
                        "light.maxdepth": depth,
                        "path.russianroulette.depth": depth + 1,
                        "lightstrategy.type": "POWER",
                        "sampler.type": "SOBOL",
                        "sampler.sobol.adaptive.strength": 0.0,
                        "film.width": scene.size,
                        "film.height": scene.size,
                        "film.filter.type": "NONE",
                        "film.imagepipelines.0.0.type": "NOP",
                    }
                ),
                lux,
            )
        )
        session.Start()
        begin, cpu = time.perf_counter(), time.process_time()
        time.sleep(seconds)
        session.UpdateStats()
        session.Stop()
        seconds, cpu = time.perf_counter() - begin, time.process_time() - cpu
        samples = session.GetStats().Get("stats.renderengine.pass").GetFloat()
        picture = np.zeros((scene.size, scene.size, 3), dtype=np.float32)
        session.GetFilm().GetOutputFloat(
            pyluxcore.FilmOutputType.RGB_IMAGEPIPELINE, picture, 0, True
        )
        return picture, samples, seconds, cpu

    serve(render)


def _translate(scene: _plain.PlainScene):
    lux = pyluxcore.Scene()
    pixel = 2.0 / scene.size  # its pictures are one row lower than everybody else's
    camera = {
        "scene.camera.type": "perspective",
        "scene.camera.lookat.orig": [*scene.eye],
        "scene.camera.lookat.target": [*(scene.eye + scene.forward)],
        "scene.camera.up": [*scene.up],
        "scene.camera.fieldofview": scene.field_of_view,
        "scene.camera.screenwindow": [-1.0, 1.0, -1.0 - pixel, 1.0 - pixel],
        "scene.camera.autovolume.enable": False,
    }
    lux.Parse(_properties(camera))
    if any(scene.world):
        world = {"scene.lights.world.type": "constantinfinite"}
        world["scene.lights.world.color"] = list(scene.world)
        lux.Parse(_properties(world))
    for number, body in enumerate(scene.bodies):
        surface, color = body.surface, list(body.surface.color)
        name = f"scene.materials.m{number}"
        material = {
            "diffuse": {"type": "matte", "kd": color},
            "glass": {"type": "glass", "kr": color, "kt": color, "interiorior": surface.ior},
            "emission": {"type": "matte", "kd": [0.0, 0.0, 0.0], "emission": color},
        }[surface.kind]
        lux.Parse(_properties({f"{name}.{key}": value for key, value in material.items()}))
        normals = None if body.normals is None else [tuple(map(float, n)) for n in body.normals]
        lux.DefineMesh(
            f"mesh{number}",
            [tuple(map(float, p)) for p in body.positions],
            [tuple(map(int, t)) for t in body.triangles],
            *(normals, None, None, None),
        )
        shape = {f"scene.objects.o{number}.shape": f"mesh{number}"}
        shape[f"scene.objects.o{number}.material"] = f"m{number}"
        lux.Parse(_properties(shape))
    return lux


def _properties(values: dict):
    properties = pyluxcore.Properties()
    for key, value in values.items():
        if isinstance(value, list):
            value = [float(v) for v in value]  # NumPy's numbers would be taken as raw bytes
        properties.Set(pyluxcore.Property(key, value))
    return properties


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
