#include "renderer/frame/LobeTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "shaders/shared/lobe_table.h"
#include "shaders/shared/models.h"

namespace tessera::frame {

namespace {

using std::numbers::pi;
constexpr double kSmallestAlpha = ALPHA_MIN, kSmallestCosine = 1e-4;
constexpr int kNodes = 64, kTurns = 16; ///< of the integrals: radial and angular nodes
constexpr double kGolden = 0.618033988749895;

struct Sample {
    double cosLight = 0.0, cosIncidence = 0.0;
    double weight = 0.0; ///< D G / (4 n.v) dl without masking of the light; sums to 1
};

struct DiskPoint {
    double x = 0.0, y = 0.0, rim = 0.0; ///< rim: the largest y there
    double weight = 0.0;                ///< sums to 1
};

/// Points on a golden-angle spiral: all radii and angles differ, so that discontinuities of the integrand average out.
/// Denser at the rim, whose microfacets are farthest from the normal.
std::array<DiskPoint, kNodes * kTurns> diskPoints() {
    std::array<DiskPoint, kNodes * kTurns> points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double place = double(i) + 0.5, left = 1.0 - place / double(points.size());
        const double radius = std::sqrt(1.0 - std::pow(left, 4.0)), angle = 2.0 * pi * std::fmod(kGolden * place, 1.0);
        const double x = radius * std::cos(angle);
        points[i] = {x, radius * std::sin(angle), std::sqrt(1.0 - x * x),
                     4.0 * left * left * left / double(points.size())};
    }
    return points;
}

/// Maps disk points to visible microfacet normals, and those to light directions. Source: Heitz 2018, "Sampling the GGX
/// Distribution of Visible Normals".
template <typename Visitor>
void visitVisible(double alpha, double cosView, const Visitor& visit) {
    static const auto points = diskPoints();
    const double sine = std::sqrt(1.0 - cosView * cosView);
    const glm::dvec3 viewer(sine, 0.0, cosView);
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * viewer.x, 0.0, viewer.z));
    const glm::dvec3 second(-stretched.z, 0.0, stretched.x); // the first is y
    const double share = 0.5 * (1.0 + stretched.z);
    for (const DiskPoint& point : points) {
        const double y = (1.0 - share) * point.rim + share * point.y;
        const double z = std::sqrt(std::max(0.0, 1.0 - point.x * point.x - y * y));
        const glm::dvec3 facet = point.x * glm::dvec3(0.0, 1.0, 0.0) + y * second + z * stretched;
        const glm::dvec3 half = glm::normalize(glm::dvec3(alpha * facet.x, alpha * facet.y, std::max(facet.z, 1e-9)));
        const double incidence = glm::dot(viewer, half);
        visit(Sample{2.0 * incidence * half.z - cosView, incidence, point.weight});
    }
}

/// Smith's length term, as in shaders.
double smithLength(double alpha, double cosine) {
    return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
}

double dielectric(double ior, double cosine) {
    const double g2 = ior * ior - 1.0 + cosine * cosine;
    if (g2 < 0.0) return 1.0;
    const double g = std::sqrt(g2);
    if (g + cosine == 0.0) return 1.0;
    const double first = (g - cosine) / (g + cosine);
    const double second = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * first * first * (1.0 + second * second);
}

/// tan^4 of the angle with this cosine. Near index 1 the reflectance relative to normal incidence is 1 plus this.
double tangent4(double cosine) {
    const double cosine2 = std::max(cosine * cosine, 1e-12), tangent2 = (1.0 - cosine2) / cosine2;
    return tangent2 * tangent2;
}

double fifth(double x) {
    return x * x * x * x * x;
}

/// Cosine-weighted mean over light directions of `value(cosine of the light, of incidence)`.
template <typename Value>
double diffuseMean(double cosView, const Value& value) {
    const double sine = std::sqrt(1.0 - cosView * cosView);
    double sum = 0.0;
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kTurns; ++j) {
            const double sine2 = (i + 0.5) / kNodes, angle = 2.0 * pi * (j + 0.5) / kTurns;
            const double cosLight = std::sqrt(1.0 - sine2);
            const double ofBoth = cosLight * cosView + std::sqrt(sine2) * sine * std::cos(angle);
            sum += value(cosLight, std::sqrt(0.5 * (1.0 + ofBoth)));
        }
    return sum / (kNodes * kTurns);
}

/// The integral of Blinn's highlight (n.h)^p [n.l > 0] over light directions times p + 2, from half vectors with the
/// density (p + 1) / 2 pi (n.h)^p. It tends to 8 pi n.v, so it can be interpolated and holds for narrower lobes too.
double blinn(double exponent, double cosView) {
    const double sine = std::sqrt(1.0 - cosView * cosView);
    double sum = 0.0;
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kTurns; ++j) {
            const double cosHalf = std::pow((i + 0.5) / kNodes, 1.0 / (exponent + 1.0));
            // Rotates each circle by the golden ratio of a step, so that the edge at the horizon averages out.
            const double angle = 2.0 * pi * (j + std::fmod(kGolden * (i + 0.5), 1.0)) / kTurns;
            const double incidence = cosHalf * cosView + std::sqrt(1.0 - cosHalf * cosHalf) * sine * std::cos(angle);
            if (incidence > 0.0 && 2.0 * incidence * cosHalf - cosView > 0.0) sum += 4.0 * incidence;
        }
    return sum / (kNodes * kTurns) * 2.0 * pi * (exponent + 2.0) / (exponent + 1.0);
}

// Sheen: the formulas of shaders/lib/reflectance/sheen.glsl.
double charlieFit(double x, double alpha) {
    const double w = (1.0 - alpha) * (1.0 - alpha);
    return std::lerp(21.5473, 25.3245, w) /
               (1.0 + std::lerp(3.82987, 3.32435, w) * std::pow(x, std::lerp(0.19823, 0.16801, w))) +
           std::lerp(-1.97760, -1.27393, w) * x + std::lerp(-4.32054, -4.85967, w);
}
double charlieLambda(double alpha, double cosine) {
    return std::exp(cosine < 0.5 ? charlieFit(cosine, alpha)
                                 : 2.0 * charlieFit(0.5, alpha) - charlieFit(1.0 - cosine, alpha));
}
double sheen(double alpha, double cosView) {
    const double sine = std::sqrt(1.0 - cosView * cosView);
    double sum = 0.0;
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kTurns; ++j) {
            const double cosLight = (i + 0.5) / kNodes, angle = 2.0 * pi * (j + 0.5) / kTurns;
            const glm::dvec3 light(std::sqrt(1.0 - cosLight * cosLight) * std::cos(angle),
                                   std::sqrt(1.0 - cosLight * cosLight) * std::sin(angle), cosLight);
            const glm::dvec3 half = glm::normalize(light + glm::dvec3(sine, 0.0, cosView));
            const double sineHalf = std::sqrt(std::max(0.0, 1.0 - half.z * half.z));
            const double d = (2.0 + 1.0 / alpha) * std::pow(sineHalf, 1.0 / alpha) / (2.0 * pi);
            sum += d / ((1.0 + charlieLambda(alpha, cosLight) + charlieLambda(alpha, cosView)) * 4.0 * cosView);
        }
    return sum / (kNodes * kTurns) * 2.0 * pi;
}
double sheenAlbedo(double alpha, double cosine) {
    constexpr double kFit[5][5] = {{0.91988, -5.00894, 6.4925, -1.28465, -1.16741},
                                   {0.184121, -10.31, 16.0261, -8.39721, -0.622238},
                                   {-0.138722, -8.60875, 46.7629, -71.9604, 37.6528},
                                   {-0.227684, 6.143, -19.9518, 30.9158, -21.028},
                                   {0.0428847, -0.844431, 2.72363, -10.4857, 10.4773}};
    const double r = std::max(std::sqrt(alpha), 0.05), x = std::min(cosine / r, 5.0);
    double logarithm = 0.0;
    for (int row = 4; row >= 0; --row) {
        double inR = 0.0;
        for (int column = 4; column >= 0; --column) inR = inR * r + kFit[row][column];
        logarithm = logarithm * x + inR;
    }
    return std::min(std::exp(logarithm), 1.0);
}

/// The index of refraction at a place of shared::iorPlace().
double iorAt(int place) {
    constexpr int kAbove = LOBE_TABLE_IORS - 1 - LOBE_TABLE_IOR_ONE;
    const double from = place - LOBE_TABLE_IOR_ONE;
    const double contrast =
        std::clamp(std::pow(std::abs(from) / (from > 0.0 ? kAbove : LOBE_TABLE_IOR_ONE), 3.0), 0.0, 0.999);
    return from > 0.0 ? (1.0 + contrast) / (1.0 - contrast) : (1.0 - contrast) / (1.0 + contrast);
}

/// The viewer's cosine at a column of shared::lobeColumn().
double cosineAt(double ior, double column) {
    if (ior >= 1.0) return column * column;
    constexpr double kEdge = LOBE_TABLE_CRITICAL / (LOBE_TABLE_SIDE - 1.0);
    const double critical = std::sqrt(1.0 - ior * ior);
    if (column >= kEdge) {
        const double beyond = (column - kEdge) / (1.0 - kEdge);
        return critical + (1.0 - critical) * beyond * beyond;
    }
    const double share = column / kEdge, left = 1.0 - share;
    return critical * (share < 0.5 ? 2.0 * share * share : 1.0 - 2.0 * left * left);
}

/// G2 / G1(viewer) of separable masking.
double separable(double alpha, double cosLight) {
    return 2.0 * cosLight / (cosLight + smithLength(alpha, cosLight));
}

double reflectedByDielectric(double ior, double alpha, double cosView) {
    double reflected = 0.0;
    visitVisible(alpha, cosView, [&](const Sample& sample) {
        if (sample.cosLight > 0.0)
            reflected += sample.weight * separable(alpha, sample.cosLight) * dielectric(ior, sample.cosIncidence);
    });
    return reflected;
}

} // namespace

std::vector<glm::vec4> makeLobeTable() {
    constexpr std::size_t kSide = LOBE_TABLE_SIDE, kLayer = kSide * kSide;
    std::vector<glm::vec4> table(kLayer * LOBE_TABLE_LAYERS, glm::vec4(0.0f));
    std::array<double, LOBE_TABLE_IORS> iors{};
    for (std::size_t i = 0; i < iors.size(); ++i) iors[i] = iorAt(int(i));
    tbb::parallel_for(std::size_t{0}, kLayer, [&](std::size_t at) {
        const double right = double(at % kSide) / (kSide - 1.0), up = double(at / kSide) / (kSide - 1.0);
        const double cosView = std::max(right * right, kSmallestCosine), alpha = std::max(up * up, kSmallestAlpha);
        const double viewLength = smithLength(alpha, cosView);
        glm::dvec4 ggx(0.0);
        std::array<double, LOBE_TABLE_IORS> ofIors{};
        double whole = 0.0, tangents4 = 0.0; // with separable masking: means of F = 1 and of tan^4(incidence)
        visitVisible(alpha, cosView, [&](const Sample& sample) {
            if (!(sample.cosLight > 0.0)) return;
            const double lightLength = smithLength(alpha, sample.cosLight);
            const double correlated =
                sample.cosLight * (cosView + viewLength) / (sample.cosLight * viewLength + cosView * lightLength);
            ggx.x += sample.weight * correlated;
            ggx.y += sample.weight * correlated * fifth(1.0 - sample.cosIncidence);
            const double weight = sample.weight * separable(alpha, sample.cosLight);
            whole += weight;
            tangents4 += weight * tangent4(sample.cosIncidence);
            for (std::size_t i = LOBE_TABLE_IOR_ONE + 1; i < iors.size(); ++i)
                ofIors[i] += weight * dielectric(iors[i], sample.cosIncidence);
        });
        const double incidence = whole > 0.0 ? 1.0 / std::sqrt(1.0 + std::sqrt(tangents4 / whole)) : cosView;
        ofIors[LOBE_TABLE_IOR_ONE] = whole;
        for (std::size_t i = LOBE_TABLE_IOR_ONE + 1; i < iors.size(); ++i) ofIors[i] /= dielectric(iors[i], incidence);
        for (std::size_t i = 0; i < LOBE_TABLE_IOR_ONE; ++i)
            ofIors[i] =
                reflectedByDielectric(iors[i], alpha, std::clamp(cosineAt(iors[i], right), kSmallestCosine, 1.0));
        ggx.z = blinn(std::max(2.0 / (alpha * alpha) - 2.0, 0.0), cosView);
        ggx.w = diffuseMean(cosView, [](double, double cosIncidence) { return fifth(1.0 - cosIncidence); });
        table[at] = glm::vec4(ggx);
        const double ofViewer = sheenAlbedo(alpha, cosView);
        table[LOBE_LAYER_SHEEN * kLayer + at] = glm::vec4(
            float(sheen(alpha, cosView)),
            float(diffuseMean(
                cosView, [&](double cosLight, double) { return std::max(sheenAlbedo(alpha, cosLight), ofViewer); })),
            float(std::sqrt(incidence)), 0.0f);
        for (std::size_t i = 0; i < LOBE_TABLE_IORS; ++i)
            table[(LOBE_LAYER_DIELECTRIC + i / 4) * kLayer + at][int(i % 4)] = float(ofIors[i]);
    });
    return table;
}

} // namespace tessera::frame
