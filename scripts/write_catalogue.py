#!/usr/bin/env python3
"""In: tables of glasses, extinction and metals (CSV, from the refractiveindex.info database, public domain).
Out: src/materials/catalogue_data.cpp on standard output, with the figures as they are printed in the tables.

    write_catalogue.py glasses.csv glass_absorption.csv metals.csv > src/materials/catalogue_data.cpp

glasses.csv: maker,name,formula,from_um,to_um,nd,vd,kelvin,coefficients; the others: name columns, wavelength_um, (n,) k.
Most tables of extinction share their wavelengths with others: each such grid is written once."""

import csv
import sys

FORMULAS = {f"formula {number}" for number in range(1, 10)}
# 1 exactly by the convention that indices are relative to air, and built in.
LEFT_OUT = {("other", "air")}
# Index relative to vacuum and wavelength in vacuum, by the source (Daimon and Masumura, Appl. Opt. 46 (2007) 3811).
ABSOLUTE = {("other", "water")}


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    """The figure as printed, once it is certain that it is one; without zeros that say nothing."""
    float(text)
    mantissa, _, exponent = text.upper().partition("E")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".") or "0"
    sign = "-" if exponent.startswith("-") else ""
    short = mantissa + (f"E{sign}{exponent.lstrip('+-').lstrip('0') or '0'}" if exponent else "")
    assert float(short) == float(text), text
    return short


def array(name, items):
    """One constexpr array of doubles, wrapped at 110 columns."""
    lines, line = [], f"constexpr double {name}[] = {{"
    for i, item in enumerate(items):
        piece = item + ("};" if i + 1 == len(items) else ",")
        if len(line) + len(piece) > 110:
            lines.append(line)
            line = ""
        line += piece
    return "\n".join(lines + [line])


def columns(rows, what, *names):
    """The columns of rows in the order of wavelength, which must not occur twice, unless with the same figures."""
    rows = {tuple(row.items()): row for row in rows}.values()
    rows = sorted(rows, key=lambda row: float(row["wavelength_um"]))
    um = [float(row["wavelength_um"]) for row in rows]
    if any(b <= a for a, b in zip(um, um[1:])):
        sys.exit(f"{what}: a wavelength occurs twice")
    return [tuple(number(row[name]) for row in rows) for name in names]


def by(rows, *keys):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def main(glasses_csv, absorption_csv, metals_csv):
    absorption = by(read(absorption_csv), "maker", "name")
    arrays, grids, glass_rows, metal_rows = [], {}, [], []
    for i, row in enumerate(read(glasses_csv)):
        key = (row["maker"], row["name"])
        if key in LEFT_OUT:
            continue
        if row["formula"] not in FORMULAS:
            sys.exit(f"{key[1]}: {row['formula']} is not one of {sorted(FORMULAS)}")
        maker = key[0] if key[0] == "other" else key[0].upper()
        arrays.append(array(f"c{i}", [number(c) for c in row["coefficients"].split()]))
        extinction = "{}, {}"
        if key in absorption:
            um, k = columns(absorption.pop(key), key, "wavelength_um", "k")
            grid = grids.setdefault(um, f"grid{len(grids)}")
            arrays.append(array(f"k{i}", k))
            extinction = f"{grid}, k{i}"
        figures = ", ".join(number(row[column] or "0") for column in ("from_um", "to_um", "nd", "vd"))
        absolute = "true" if key in ABSOLUTE else "false"
        glass_rows.append(f'    {{"{maker}", "{key[1]}", {row["formula"][-1]}, {absolute}, {figures}, c{i}, {extinction}}},')
    if absorption:
        sys.exit(f"{absorption_csv}: {sorted(absorption)[0]} is not in {glasses_csv}")
    for (name,), points in by(read(metals_csv), "name").items():
        for column, figures in zip(("um", "n", "k"), columns(points, name, "wavelength_um", "n", "k")):
            arrays.append(array(f"{name}_{column}", figures))
        metal_rows.append(f'    {{"{name}", {name}_um, {name}_n, {name}_k}},')

    print("// In: nothing. Out: glasses and metals, from the refractiveindex.info database (public domain, CC0).")
    print("// Written by scripts/write_catalogue.py: change that, or its tables, and not this file.")
    print("// clang-format off")
    print('#include "materials/catalogue_data.h"\n\nnamespace sahl {\nnamespace {\n')
    print("\n".join(array(name, um) for um, name in grids.items()))
    print("\n".join(arrays))
    print("\nconstexpr GlassRow glasses[] = {", *glass_rows, "};\n", sep="\n")
    print("constexpr MetalRow metals[] = {", *metal_rows, "};\n\n} // namespace\n", sep="\n")
    print("std::span<GlassRow const> glass_rows() { return glasses; }")
    print("std::span<MetalRow const> metal_rows() { return metals; }\n\n} // namespace sahl")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
