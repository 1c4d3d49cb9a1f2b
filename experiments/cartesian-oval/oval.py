#!/usr/bin/env python3
"""Prints the front of the lens in cartesian-oval.toml: radius, conic constant, aspheric terms of Descartes' oval.

The oval is the surface z(r) from whose every point the optical path from (0, 0, −a) in air and on to (0, 0, b) in glass
is the same. Its series in u = r² is found in fractions, exactly; the conic that agrees with it up to r⁴ is taken off.
Needs Python alone.
"""

from fractions import Fraction

A, B, N = Fraction(200), Fraction(150), Fraction("1.5168")  # mm, mm, index
TERMS = 16  # of the series; at r = 20 mm the last is below 1e-16 mm


def times(p, q):
    out = [Fraction(0)] * TERMS
    for i, x in enumerate(p):
        for j in range(TERMS - i):
            out[i + j] += x * q[j]
    return out


def plus(*series):
    return [sum(terms) for terms in zip(*series)]


def scaled(factor, p):
    return [factor * x for x in p]


def constant(x):
    return [x] + [Fraction(0)] * (TERMS - 1)


def defect(z):
    """(A² − n²B² − c²)² − 4 c² n² B²: zero on the oval, A and B the ways, c = a + n b the optical path."""
    u = [Fraction(0), Fraction(1)] + [Fraction(0)] * (TERMS - 2)
    before, after = plus(z, constant(A)), plus(constant(B), scaled(-1, z))
    a2, b2 = plus(times(before, before), u), plus(times(after, after), u)
    c = A + N * B
    inner = plus(a2, scaled(-N * N, b2), constant(-c * c))
    return plus(times(inner, inner), scaled(-4 * c * c * N * N, b2))


def oval():
    """z as a series in u, one coefficient after another: each enters its own order of the defect linearly."""
    z = constant(Fraction(0))
    for order in range(1, TERMS):
        z[order] = Fraction(0)
        without = defect(z)[order]
        z[order] = Fraction(1)
        z[order] = -without / (defect(z)[order] - without)
    return z


def conic(curvature, k):
    """The series of c u / (1 + √(1 − (1 + k) c² u)): Catalan's numbers."""
    z, term = [Fraction(0)], curvature / 2
    for order in range(1, TERMS):
        z.append(term)
        term *= (1 + k) * curvature**2 / 4 * Fraction(2 * (2 * order - 1), order + 1)
    return z


def main():
    z = oval()
    curvature = 2 * z[1]
    k = 8 * z[2] / curvature**3 - 1
    rest = plus(z, scaled(-1, conic(curvature, k)))
    print(f"r1_mm = {float(1 / curvature)!r}, conic1 = {float(k)!r},")
    print("aspheric1 = [" + ", ".join(repr(float(x)) for x in rest[2:]) + "]")


if __name__ == "__main__":
    main()
