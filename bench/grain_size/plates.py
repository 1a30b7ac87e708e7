#!/usr/bin/python3
"""What the size of the grains does to plates of one size: the tables of docs/lab/grain-size.md, from plates/.

Sinkage counts from the mean surface seen from above, or from the seat, where a plate first bears 1 kPa. Means over
packings with their standard errors by the packings' scatter.

    bench/grain_size/plates.py
"""
import json
import pathlib

import numpy

HERE = pathlib.Path(__file__).parent
SEATED = 1e3  # [Pa]
SANDS = {"rover-sand": (("12mm", "8.4mm", "6mm"), (4, 8, 12)), "paper-sand": (("40mm", "28mm", "20mm"), (16, 32, 48))}


def mean(values):
    error = numpy.std(values, ddof=1) / len(values) ** 0.5 if len(values) > 1 else numpy.nan
    return f"{numpy.mean(values):.1f} ± {error:.1f}"


def plates(sand, size):
    """The documents of a sand's packings."""
    return [json.loads(file.read_text()) for file in sorted((HERE / "plates").glob(f"{sand}-{size}-*.json"))]


def pressures(documents, plate, sinkage, from_seat):
    """Of one plate, by its place in the list, at a sinkage [mm], in kPa."""
    found = []
    for document in documents:
        run = document["runs"][plate]
        z, p = numpy.array(run["sinkage"]), numpy.array(run["pressure"])
        seat = z[numpy.argmax(p > SEATED)] if from_seat else 0.0
        found.append(numpy.interp(1e-3 * sinkage, z - seat, p) / 1e3)
    return found


def seats(documents):
    """Where the plates first bear 1 kPa [mm]."""
    runs = [run for document in documents for run in document["runs"]]
    return [1e3 * run["sinkage"][numpy.argmax(numpy.array(run["pressure"]) > SEATED)] for run in runs]


def exponent(document, least):
    """Bekker's n of a packing: the slope of ln p over ln z that its plates share, z from the seat and above `least`."""
    rows, values = [], []
    for plate, run in enumerate(document["runs"]):
        z, p = numpy.array(run["sinkage"]), numpy.array(run["pressure"])
        z = z - z[numpy.argmax(p > SEATED)]
        for x, y in zip(z[(z > least) & (p > 0)], p[(z > least) & (p > 0)]):
            rows.append([float(k == plate) for k in range(len(document["runs"]))] + [numpy.log(x)])
            values.append(numpy.log(y))
    return numpy.linalg.lstsq(numpy.array(rows), numpy.array(values), rcond=None)[0][-1]


for sand, (sizes, sinkages) in SANDS.items():
    for size in sizes:
        documents = plates(sand, size)
        print(f"{sand} {size}: {len(documents)} packings, void ratio "
              f"{numpy.mean([d['runs'][0]['void_ratio'] for d in documents]):.3f}, seat at {mean(seats(documents))} mm, "
              f"100 n {mean([100 * exponent(d, 1e-3 * sinkages[0] / 4) for d in documents])}")
        for from_seat in (True, False):
            for plate, run in enumerate(documents[0]["runs"]):
                row = [mean(pressures(documents, plate, z, from_seat)) for z in sinkages]
                print(f"  {1e3 * run['diameter']:g} mm, z from {'the seat' if from_seat else 'the mean surface'}: "
                      + ", ".join(f"{z} mm {p} kPa" for z, p in zip(sinkages, row)))
