#!/usr/bin/env python3
"""Fits a diffusion profile of Gaussians to the dipole of a material. Usage: tools/fit_profile.py [marble]

Prints the variances in mm^2, the weights by channel, and the relative error of each channel:
sqrt(integral r (fit - dipole)^2 dr / integral r dipole^2 dr). Coefficients: Jensen, Marschner, Levoy and Hanrahan 2001,
"A Practical Model for Subsurface Light Transport", figure 5. The fit follows d'Eon, Luebke and Enderton 2007,
"Efficient Rendering of Human Skin", with variances that ascend by one ratio and weights that are not negative.
"""
import math
import sys

# By channel: reduced scattering and absorption in 1/mm, and the index of refraction.
MATERIALS = {"marble": ((2.19, 2.62, 3.00), (0.0021, 0.0041, 0.0071), 1.5)}


def dipole(scattering, absorption, ior):
    """The diffuse reflectance at a distance in mm, in 1/mm^2."""
    extinction = scattering + absorption
    albedo = scattering / extinction
    decay = math.sqrt(3.0 * absorption * extinction)
    fresnel = -1.440 / ior**2 + 0.710 / ior + 0.668 + 0.0636 * ior
    boundary = (1.0 + fresnel) / (1.0 - fresnel)
    depth = 1.0 / extinction
    above = depth * (1.0 + 4.0 / 3.0 * boundary)

    def reflectance(r):
        total = 0.0
        for z in (depth, above):
            d = math.hypot(r, z)
            total += z * (decay * d + 1.0) * math.exp(-decay * d) / d**3
        return albedo / (4.0 * math.pi) * total

    return reflectance


def gaussian(variance, r):
    return math.exp(-r * r / (2.0 * variance)) / (2.0 * math.pi * variance)


def fit(profile, variances, radii):
    """Weights that are not negative and sum to 1: least squares by descent along one coordinate at a time."""
    steps = [radii[i + 1] - radii[i] for i in range(len(radii) - 1)] + [0.0]
    weight = [r * dr for r, dr in zip(radii, steps)]
    total = 2.0 * math.pi * sum(w * profile(r) for w, r in zip(weight, radii))
    wanted = [profile(r) / total for r in radii]
    basis = [[gaussian(v, r) for r in radii] for v in variances]
    products = [[sum(w * a * b for w, a, b in zip(weight, x, y)) for y in basis] for x in basis]
    against = [sum(w * a * b for w, a, b in zip(weight, x, wanted)) for x in basis]
    weights = [1.0 / len(variances)] * len(variances)
    for _ in range(20000):
        for i in range(len(weights)):
            rest = against[i] - sum(products[i][j] * weights[j] for j in range(len(weights)) if j != i)
            weights[i] = max(rest / products[i][i], 0.0)
    scale = sum(weights)
    weights = [w / scale for w in weights]
    fitted = [sum(w * b[k] for w, b in zip(weights, basis)) for k in range(len(radii))]
    error = sum(w * (f - x) ** 2 for w, f, x in zip(weight, fitted, wanted))
    return weights, math.sqrt(error / sum(w * x * x for w, x in zip(weight, wanted)))


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else "marble"
    scattering, absorption, ior = MATERIALS[name]
    radii = [1e-3 * 1.012**i for i in range(900)]
    variances = [0.03 * 4.2**i for i in range(6)]
    channels = [fit(dipole(s, a, ior), variances, radii) for s, a in zip(scattering, absorption)]
    for i, variance in enumerate(variances):
        print(f"{variance:9.4g}  " + "  ".join(f"{weights[i]:.3f}" for weights, _ in channels))
    print("error      " + "  ".join(f"{error:.3f}" for _, error in channels))


main()
