"""How fast something grows with a size: the exponent of a fixed part and a power of the size."""
import math

FLAT = 0.3  # a growth by less than this share, over all sizes, is none: as much is noise


def fitted(sizes, values, power):
    """Fixed part, factor and misfit of a + b n^power, by least squares of ratios; neither part is negative."""
    rows = [(1 / value, size**power / value) for size, value in zip(sizes, values)]
    s11, s12, s22 = (sum(row[i] * row[j] for row in rows) for i, j in ((0, 0), (0, 1), (1, 1)))
    s1, s2 = sum(row[0] for row in rows), sum(row[1] for row in rows)
    determinant = s11 * s22 - s12 * s12
    fixed, factor = 0.0, s2 / s22
    if determinant > 1e-12 * s11 * s22:
        both = ((s22 * s1 - s12 * s2) / determinant, (s11 * s2 - s12 * s1) / determinant)
        fixed, factor = both if min(both) >= 0 else (fixed, factor)
    misfit = sum((fixed * row[0] + factor * row[1] - 1) ** 2 for row in rows)
    return fixed, factor, misfit


def exponent(sizes, values):
    """p of the a + b n^p that is nearest to the values, in ratio; 0 where they hardly grow."""
    if max(values) < (1 + FLAT) * values[0]:
        return 0.0
    unit = [size / sizes[0] for size in sizes]
    powers = [step / 50 for step in range(1, 201)]
    return min(powers, key=lambda power: fitted(unit, values, power)[2])


def last_exponent(sizes, values, start):
    """Of the last step, without what the program takes at its start. The most memory is the most of several parts', not
    their sum: a part that is not yet the largest says nothing."""
    if values[-1] < (1 + FLAT) * values[0]:
        return 0.0
    rest = [max(value - start, 0.01 * start) for value in values[-2:]]
    return math.log(rest[1] / rest[0]) / math.log(sizes[-1] / sizes[-2])


def check():
    """Laws that are known, a twentieth of noise on each: what is linear passes where what is quadratic does not."""
    sizes, noise = [10, 20, 40, 80], [1.05, 0.95, 1.0, 1.05]
    laws = ((lambda n: 5 + n, 0.7, 1.3), (lambda n: 100 + n * n / 10, 1.6, 2.4), (lambda n: 50 + n / 100, 0, 0),
            (lambda n: n**3, 2.7, 3.3), (lambda n: 20 + n + n * n / 20, 1.4, 2))
    for law, low, high in laws:
        found = exponent(sizes, [law(n) * factor for n, factor in zip(sizes, noise)])
        assert low <= found <= high, f"a law was fitted by {found}, not from {low} to {high}"
    for law, power in ((lambda n: max(500, 9 * n), 1), (lambda n: max(500, n * n), 2)):
        found = last_exponent(sizes, [80 + law(n) for n in sizes], 80)
        assert abs(found - power) < 0.2 or power == 1 and found < 1, f"a law of {power} was measured as {found}"
