# The bed of bench/peers/peer_bed.cpp in YADE: same positions; Hertz-Mindlin by its own formulas, rolling resistance by its
# moment law with the same limit for a mean grain. Run by yade; BED, WARM and STEPS come by the environment, threads by -j.
import math
import os
import time

from yade import O, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator
from yade.wrapper import (Bo1_Sphere_Aabb, Bo1_Wall_Aabb, FrictMat, Ig2_Sphere_Sphere_ScGeom, Ig2_Wall_Sphere_ScGeom,
                          Ip2_FrictMat_FrictMat_MindlinPhys, Law2_ScGeom_MindlinPhys_Mindlin)
from yade import utils

GRAINS, LENGTH, WIDTH = 57000, 6.0, 1.0
MEAN = 0.01  # R* of two mean grains [m]

sand = O.materials.append(FrictMat(young=31.75e6, poisson=0.18, frictionAngle=math.atan(0.5), density=2463.51))
with open(os.environ["BED"], encoding="utf-8") as file:
    rows = file.read().split("Atoms # sphere")[1].split("\n")
for row in rows:
    words = row.split()
    if words:
        diameter, x, y, z = float(words[2]), *map(float, words[4:7])
        O.bodies.append(utils.sphere((x, y, z), diameter / 2, material=sand))
for place, axis, sense in ((0, 2, 1), (0, 0, 1), (LENGTH, 0, -1), (0, 1, 1), (WIDTH, 1, -1)):
    O.bodies.append(utils.wall(place, axis=axis, sense=sense, material=sand))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.001),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.56, es=0.56, eta=0.1 * MEAN, krot=5000 * MEAN**2)],
                    [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=True)]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
]
O.dt = 5e-5
O.run(int(os.environ["WARM"]), True)
steps = int(os.environ["STEPS"])
start = time.time()
O.run(steps, True)
seconds = time.time() - start

forces = [i.phys.normalForce.norm() for i in O.interactions if i.isReal and max(i.id1, i.id2) < GRAINS]
print(f"yade threads={O.numThreads} particle_steps_per_second={GRAINS * steps / seconds:.5g} "
      f"mean_force={sum(forces) / len(forces):.6g} coordination={2 * len(forces) / GRAINS:.6g}")
