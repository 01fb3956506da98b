# SPDX-License-Identifier: GPL-3.0-or-later
"""Mitsuba's path tracer as a service: `_mitsuba.py CAPTURE THREADS`.

It renders a number of samples in one go; the number comes from the speed of the render before.
"""

import sys
import time

import _plain
import drjit
import mitsuba
import numpy as np
from _peer import load, serve


def main(path: str, threads: int) -> None:
    scene = load(path)
    mitsuba.set_variant("scalar_rgb")  # those for LLVM crash with some of its versions
    drjit.set_thread_count(threads)
    loaded = mitsuba.load_dict(_translate(scene))

    def timed(samples: int, seed: int):
        begin, cpu = time.perf_counter(), time.process_time()
        picture = np.array(mitsuba.render(loaded, spp=samples, seed=seed))
        return picture, time.perf_counter() - begin, time.process_time() - cpu

    rate = [16.0 / timed(16, 0)[1]]

    def render(seconds: float, seed: int):
        samples = max(round(rate[0] * seconds), 1)
        picture, seconds, cpu = timed(samples, seed)
        rate[0] = samples / seconds
        return picture[::-1, :, :3], samples, seconds, cpu

    serve(render)


def _translate(scene: _plain.PlainScene) -> dict:
    transform = mitsuba.ScalarTransform4f
    eye, target = scene.eye, scene.eye + scene.forward
    result = {
        "type": "scene",
        # Its depth is of edges: one more than the bounces for light, another for the camera.
        "integrator": {"type": "path", "max_depth": scene.max_bounces + 2},
        "sensor": {
            "type": "perspective",
            "fov": scene.field_of_view,
            "to_world": transform().look_at([*eye], [*target], [*scene.up]),
            "near_clip": 1e-3,
            "film": {
                "type": "hdrfilm",
                **{"width": scene.size, "height": scene.size, "pixel_format": "rgb"},
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": "independent"},
        },
    }
    if any(scene.world):
        result["world"] = {"type": "constant", "radiance": _rgb(scene.world)}
    for number, body in enumerate(scene.bodies):
        result[f"body{number}"] = _mesh(f"body{number}", body)
    return result


def _mesh(name: str, body: _plain.Body):
    surface, color = body.surface, _rgb(body.surface.color)
    properties = mitsuba.Properties()
    bsdf = {
        "diffuse": {"type": "twosided", "b": {"type": "diffuse", "reflectance": color}},
        "glass": {
            **{"type": "dielectric", "int_ior": surface.ior, "ext_ior": 1.0},
            **{"specular_reflectance": color, "specular_transmittance": color},
        },
        "emission": {"type": "diffuse", "reflectance": _rgb((0.0, 0.0, 0.0))},
    }[surface.kind]
    properties["bsdf"] = mitsuba.load_dict(bsdf)
    if surface.kind == "emission":
        properties["emitter"] = mitsuba.load_dict({"type": "area", "radiance": color})
    mesh = mitsuba.Mesh(
        *(name, len(body.positions), len(body.triangles)),
        **{"has_vertex_normals": body.normals is not None, "props": properties},
    )
    parameters = mitsuba.traverse(mesh)
    parameters["vertex_positions"] = body.positions.ravel()
    parameters["faces"] = body.triangles.ravel().astype(np.uint32)
    parameters.update()
    if body.normals is not None:  # now, as those are computed whenever vertices move
        parameters["vertex_normals"] = body.normals.ravel()
        parameters.update()
    return mesh


def _rgb(color: _plain.Color) -> dict:
    return {"type": "rgb", "value": [float(c) for c in color]}


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
