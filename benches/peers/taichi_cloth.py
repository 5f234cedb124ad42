"""A sheet of masses and springs in Taichi, in explicit steps, as Taichi's own cloth example has it.

Each particle has unit mass and up to twelve springs: to all particles that are at most two cells away, counted along the
sides. A spring accelerates its particle by `stiffness` [m/s2] times its elongation, and slows what its ends do along it by
the example's dashpot. The example damps all motion by 1 /s; here that is the scene's number, so that one motion is compared.
The example's sphere takes the inward velocity alone; here it also rubs, by Coulomb's law. Every substep is a call from
Python, as there.

Input is a file of the start [m], float32 of shape [n, n, 3]. Output is a file of the ends of all frames, float32 of shape
[frames, n, n, 3], and one line of JSON: `program`, and `milliseconds`, the wall time of each frame.
"""

import argparse
import json
import time

import numpy as np
import taichi as ti

DASHPOT = 1e4  # The example's [1/(m s)]: times the spacing, the rate at which one spring slows its ends.


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--start", required=True, help="file of the positions at the start")
    parser.add_argument("--output", required=True, help="file for the positions at the end of every frame")
    parser.add_argument("--n", type=int, required=True, help="particles on a side")
    parser.add_argument("--frames", type=int, required=True)
    parser.add_argument("--frame-seconds", type=float, required=True)
    parser.add_argument("--substeps", type=int, required=True, help="steps in a frame")
    parser.add_argument("--stiffness", type=float, required=True, help="acceleration [m/s2] per elongation of 1")
    parser.add_argument("--gravity", type=float, required=True, help="downward [m/s2]")
    parser.add_argument("--damping", type=float, required=True, help="of all motion [1/s]")
    parser.add_argument("--held", action="store_true", help="hold both ends of the first row")
    parser.add_argument("--radius", type=float, default=0.0, help="of a sphere around the origin [m]; 0 is none")
    parser.add_argument("--friction", type=float, default=0.0, help="Coulomb's coefficient on the sphere")
    return parser.parse_args()


def main():
    given = options()
    ti.init(arch=ti.cpu, log_level=ti.ERROR, offline_cache=False)
    n, dt, spacing = given.n, given.frame_seconds / given.substeps, 1.0 / (given.n - 1)
    stiffness, damping, gravity = given.stiffness, given.damping, given.gravity
    held, radius, friction = given.held, given.radius, given.friction
    position = ti.Vector.field(3, dtype=ti.f32, shape=(n, n))
    velocity = ti.Vector.field(3, dtype=ti.f32, shape=(n, n))
    near = [(i, j) for i in range(-2, 3) for j in range(-2, 3) if 0 < abs(i) + abs(j) <= 2]

    @ti.kernel
    def substep():
        for at in ti.grouped(position):
            velocity[at].y -= gravity * dt
        for at in ti.grouped(position):
            pull = ti.Vector([0.0, 0.0, 0.0])
            for offset in ti.static(near):
                other = at + ti.Vector(offset)
                if 0 <= other[0] < n and 0 <= other[1] < n:
                    span = position[other] - position[at]
                    length = span.norm()
                    along = span / length
                    rest = spacing * ti.static((offset[0] ** 2 + offset[1] ** 2) ** 0.5)
                    pull += stiffness * (length / rest - 1) * along
                    pull += DASHPOT * spacing * (velocity[other] - velocity[at]).dot(along) * along
            velocity[at] += dt * pull
        for at in ti.grouped(position):
            velocity[at] *= ti.exp(-damping * dt)
            if ti.static(radius > 0):
                if position[at].norm() <= radius:
                    normal = position[at].normalized()
                    outward = velocity[at].dot(normal)
                    sliding = velocity[at] - outward * normal
                    speed = sliding.norm()
                    if speed > 0:
                        sliding *= ti.max(0.0, 1 - friction * ti.max(0.0, -outward) / speed)
                    velocity[at] = sliding + ti.max(0.0, outward) * normal
            if ti.static(held):
                if at[0] == 0 and (at[1] == 0 or at[1] == n - 1):
                    velocity[at] = ti.Vector([0.0, 0.0, 0.0])
            position[at] += dt * velocity[at]

    position.from_numpy(np.fromfile(given.start, dtype="<f4").reshape(n, n, 3))
    velocity.fill(0)
    milliseconds = []
    with open(given.output, "wb") as output:
        for _ in range(given.frames):
            ti.sync()
            begin = time.perf_counter()
            for _ in range(given.substeps):
                substep()
            ti.sync()
            milliseconds.append(1e3 * (time.perf_counter() - begin))
            output.write(position.to_numpy().astype("<f4").tobytes())
    version = ".".join(str(part) for part in ti.__version__)
    print(json.dumps({"program": f"Taichi {version}", "milliseconds": milliseconds}), flush=True)


main()
