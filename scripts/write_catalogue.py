#!/usr/bin/env python3
"""In: tables of glasses, extinction and metals (CSV, from the refractiveindex.info database, public domain).
Out: src/materials/catalogue_data.cpp on standard output, with the figures as they are printed in the tables.

    write_catalogue.py glasses.csv glass_absorption.csv metals.csv > src/materials/catalogue_data.cpp

glasses.csv: maker,name,formula,from_um,to_um,nd,vd,kelvin,coefficients; the others: name columns, wavelength_um, (n,) k."""

import csv
import re
import sys

GLASSES = """
    schott: N-BK7 N-K5 K7 N-BAK4 N-SK16 N-SSK5 N-BAF10 N-LAK8 N-LAK10 N-LAK22 N-LASF9 N-FK51A F2 SF5 SF6 SF10 SF11
            N-SF5 N-SF6 N-SF10 N-SF11 N-SF57 BOROFLOAT33 LITHOSIL-Q LITHOTEC-CAF2
    ohara: S-LAH79 S-FPL51 S-FPL53
    hoya: FCD1
    other: water diamond fused-silica calcium-fluoride magnesium-fluoride-o sapphire-o quartz-o pmma polycarbonate
           polystyrene
"""
FORMULAS = {"formula 1", "formula 2", "formula 3"}


def wanted_glasses():
    maker = None
    for word in GLASSES.split():
        if word.endswith(":"):
            maker = word[:-1]
        else:
            yield maker, word


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    """The figure as printed, once it is certain that it is one."""
    float(text)
    return text


def array(kind, name, items):
    """One constexpr array, wrapped at 110 columns."""
    lines, line = [], f"constexpr {kind} {name}[] = {{"
    for i, item in enumerate(items):
        piece = item + ("};" if i + 1 == len(items) else ",")
        if len(line) + len(piece) > 108:
            lines.append(line.rstrip())
            line = "    "
        line += piece + " "
    return "\n".join(lines + [line.rstrip()])


def ascending(rows, what):
    rows = sorted(rows, key=lambda row: float(row["wavelength_um"]))
    um = [float(row["wavelength_um"]) for row in rows]
    if any(b <= a for a, b in zip(um, um[1:])):
        sys.exit(f"{what}: a wavelength occurs twice")
    return rows


def main(glasses_csv, absorption_csv, metals_csv):
    glasses = {(row["maker"], row["name"]): row for row in read(glasses_csv)}
    absorption = {}
    for row in read(absorption_csv):
        absorption.setdefault((row["maker"], row["name"]), []).append(row)
    metals = {}
    for row in read(metals_csv):
        metals.setdefault(row["name"], []).append(row)

    arrays, glass_rows, metal_rows = [], [], []
    for key in wanted_glasses():
        row = glasses.get(key) or sys.exit(f"{glasses_csv}: no {key[0]}:{key[1]}")
        if row["formula"] not in FORMULAS:
            sys.exit(f"{key[1]}: {row['formula']} is not one of {sorted(FORMULAS)}")
        name = re.sub(r"\W", "_", "_".join(key)).lower()
        maker = key[0] if key[0] == "other" else key[0].upper()
        arrays.append(array("double", f"{name}_c", [number(c) for c in row["coefficients"].split()]))
        extinction = "{}"
        if key in absorption:
            extinction = f"{name}_k"
            points = ascending(absorption[key], name)
            arrays.append(array("GlassRow::Extinction", extinction,
                                [f"{{{number(p['wavelength_um'])}, {number(p['k'])}}}" for p in points]))
        figures = ", ".join(number(row[column] or "0") for column in ("from_um", "to_um", "nd", "vd"))
        glass_rows.append(f'    {{"{maker}", "{key[1]}", {row["formula"][-1]}, {figures}, {name}_c, {extinction}}},')
    for name, points in metals.items():
        arrays.append(array("MetalRow::Point", name,
                            [f"{{{number(p['wavelength_um'])}, {number(p['n'])}, {number(p['k'])}}}"
                             for p in ascending(points, name)]))
        metal_rows.append(f'    {{"{name}", {name}}},')

    print("// In: nothing. Out: glasses and metals, from the refractiveindex.info database (public domain).")
    print("// Written by scripts/write_catalogue.py: change that, or its tables, and not this file.")
    print("// clang-format off")
    print('#include "materials/catalogue_data.h"\n\nnamespace sahl {\nnamespace {\n')
    print("\n".join(arrays))
    print("\nconstexpr GlassRow glasses[] = {", *glass_rows, "};\n", sep="\n")
    print("constexpr MetalRow metals[] = {", *metal_rows, "};\n\n} // namespace\n", sep="\n")
    print("std::span<GlassRow const> glass_rows() { return glasses; }")
    print("std::span<MetalRow const> metal_rows() { return metals; }\n\n} // namespace sahl")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
