#include "validation/reference/Film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "validation/reference/Microfacet.h"

namespace tessera::reference {

namespace {

constexpr int kWaveNumbers = 512;
constexpr double kFirst = 0.9, kLast = 3.1; ///< per micrometre: 323 nm to 1.1 micrometres
constexpr double kStep = (kLast - kFirst) / kWaveNumbers;
/// Longest path difference in micrometres. Beyond it interference averages out over neighbouring wavelengths, and the
/// steps would be too coarse.
constexpr double kLongestWay = 20.0;

double waveNumberOf(int index) {
    return kFirst + (index + 0.5) * kStep;
}

double normalDensity(double x, double mean, double variance) {
    return std::exp(-(x - mean) * (x - mean) / (2.0 * variance)) / std::sqrt(2.0 * std::numbers::pi * variance);
}

/// RGB weights of the reflectance at each wave number; they sum to 1 by channel.
std::array<glm::dvec3, kWaveNumbers> makeWeights() {
    std::array<glm::dvec3, kWaveNumbers> weights;
    const double first = 5.4856e-13 * std::sqrt(4.3278e9), second = 9.7470e-14 * std::sqrt(4.5282e9);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kWaveNumbers; ++i) {
        const double k = waveNumberOf(i);
        const double x =
            (first * normalDensity(k, 1.6810, 2.0 * 4.3278e-3) + second * normalDensity(k, 2.2399, 2.0 * 4.5282e-3)) /
            (first + second);
        const double y = normalDensity(k, 1.7953, 2.0 * 9.3046e-3), z = normalDensity(k, 2.2084, 2.0 * 6.6121e-3);
        weights[std::size_t(i)] = {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                                   -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                                   0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
        sum += weights[std::size_t(i)];
    }
    for (glm::dvec3& weight : weights) weight /= sum;
    return weights;
}

struct Film {
    double outer, inner; ///< Fresnel reflectances of its interfaces
    double turn;         ///< 1, or -1 where the inner interface inverts the phase
    double way;          ///< path difference of a round trip, in micrometres

    double passed() const { return (1.0 - outer) * (1.0 - outer) * inner / (1.0 - outer * inner); }
    /// Reflectance without interference.
    double mean() const { return outer + passed(); }
    /// Reflectance at a wave number, by the sum of z^m for m = 1 to 4, where z is a round trip.
    double at(double waveNumber) const {
        const std::complex<double> z =
            std::polar(std::sqrt(outer * inner), 2.0 * std::numbers::pi * way * waveNumber) * turn;
        const std::complex<double> squared = z * z, sum = z * (1.0 - squared * squared) / (1.0 - z);
        return mean() + 2.0 * (passed() - (1.0 - outer)) * sum.real();
    }
};

double reflectanceOf(const Film& film, int channel) {
    if (film.way > kLongestWay) return film.mean();
    static const std::array<glm::dvec3, kWaveNumbers> weights = makeWeights();
    double sum = 0.0;
    for (int i = 0; i < kWaveNumbers; ++i) sum += weights[std::size_t(i)][channel] * film.at(waveNumberOf(i));
    return std::clamp(sum, 0.0, 1.0);
}

} // namespace

glm::dvec3 filmReflectance(const glm::dvec3& straight, double cosine, double ior, double thicknessNm) {
    // Cached, since all lights of a pixel need the same.
    struct Answer {
        glm::dvec3 straight{-1.0};
        glm::dvec3 others{0.0}, reflectance{0.0};
    };
    thread_local Answer last;
    const glm::dvec3 others(cosine, ior, thicknessNm);
    if (last.straight == straight && last.others == others) return last.reflectance;
    const double inside = std::cos(std::asin(std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / ior));
    const auto squared = [](double x) { return x * x; };
    glm::dvec3 reflectance;
    for (int c = 0; c < 3; ++c) {
        // The index of refraction of Schlick's reflectance; a metal's is practically infinite.
        const double root = std::sqrt(std::clamp(straight[c], 0.0, 1.0 - 1e-12));
        const double below = (1.0 + root) / (1.0 - root);
        Film film{};
        film.outer = fresnelSchlick(squared((1.0 - ior) / (1.0 + ior)), 1.0, cosine);
        film.inner = fresnelSchlick(squared((ior - below) / (ior + below)), 1.0, inside);
        film.turn = (ior - below) / (ior + below) > 1e-5 ? 1.0 : -1.0; // -1 by definition where the indices are equal
        film.way = 2e-3 * ior * thicknessNm * inside;
        reflectance[c] = reflectanceOf(film, c);
    }
    last = {straight, others, reflectance};
    return reflectance;
}

} // namespace tessera::reference
