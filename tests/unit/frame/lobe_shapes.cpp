// Fitted lobe shapes of area lights (linearly transformed cosines), checked independently of the fitting program: with
// other forms of the lobe and other integration points.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/frame/LobeShapes.h"
#include "shaders/shared/lobe_shapes.h"
#include "tests/unit/docs/Tables.h"

namespace tessera::frame {
namespace {

/// The matrix that transforms light directions to a clamped cosine (shared::inverseOfShape), interpolated bilinearly as
/// in shaders. Alphas and cosines are clamped to the smallest of the table.
glm::dmat3 inverseShape(double alpha, double cosView) {
    constexpr double kLast = LOBE_SHAPES_SIDE - 1;
    alpha = std::clamp(alpha, double(LOBE_SHAPES_SMALLEST_ALPHA), 1.0);
    cosView = std::clamp(cosView, double(LOBE_SHAPES_SMALLEST_COSINE), 1.0);
    const double right = kLast * std::sqrt(cosView), up = kLast * std::sqrt(alpha);
    const double column = std::min(std::floor(right), kLast - 1.0), row = std::min(std::floor(up), kLast - 1.0);
    const auto between = [&](double y) {
        const glm::vec4* entry = lobeShapes().data() + std::size_t(y * LOBE_SHAPES_SIDE + column);
        return glm::mix(glm::dvec4(entry[0]), glm::dvec4(entry[1]), right - column);
    };
    const glm::dvec4 numbers = glm::mix(between(row), between(row + 1.0), up - row);
    const double sineView = std::sqrt(1.0 - cosView * cosView);
    return shared::inverseOfShape(glm::vec4(numbers), float(alpha), float(cosView), float(sineView));
}

/// An isotropic GGX lobe and a view direction in the xz plane.
struct ShapeView {
    double alpha = 1.0, cosine = 1.0;
    glm::dvec3 viewer() const { return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}; }
};

/// The BRDF without Fresnel, times the cosine of the light, by Smith's Lambda.
double lobeOf(const ShapeView& view, const glm::dvec3& light) {
    if (light.z <= 0.0) return 0.0;
    const glm::dvec3 half = light + view.viewer();
    const auto tangent2 = [](const glm::dvec3& d) { return (d.x * d.x + d.y * d.y) / (d.z * d.z); };
    const double alpha2 = view.alpha * view.alpha;
    const auto lambda = [&](const glm::dvec3& d) { return 0.5 * (std::sqrt(1.0 + alpha2 * tangent2(d)) - 1.0); };
    const double cosine2 = half.z * half.z / glm::dot(half, half), spread = alpha2 + tangent2(half);
    const double distribution = alpha2 / (std::numbers::pi * cosine2 * cosine2 * spread * spread);
    return distribution / ((1.0 + lambda(light) + lambda(view.viewer())) * 4.0 * view.cosine);
}

/// Density of the directions that microfacets, sampled by area, reflect the viewer to: D n.h / (4 v.h).
double facetDensity(const ShapeView& view, const glm::dvec3& light) {
    const glm::dvec3 sum = light + view.viewer();
    const double length = glm::length(sum), up = sum.z / length;
    const double side2 = (sum.x * sum.x + sum.y * sum.y) / (length * length), alpha2 = view.alpha * view.alpha;
    const double base = alpha2 * up * up + side2;
    return alpha2 * up / (std::numbers::pi * base * base * 2.0 * length);
}

struct ShapeFigures {
    double lobe = 0.0;     ///< reflectance under uniform illumination
    double share = 0.0;    ///< fraction of the shape above the surface
    double distance = 0.0; ///< integral of |lobe - shape| above the surface, both scaled to 1
};

/// Visits points of the half disc y > 0 with their weights; denser at the rim.
template <typename Visitor>
void visitPlaces(const Visitor& visit) {
    constexpr int kRings = 96, kTurns = 64;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kTurns; ++j) {
            const double left = 1.0 - (i + 0.5) / kRings, angle = std::numbers::pi * (j + 0.5) / kTurns;
            const double radius = std::sqrt(1.0 - std::pow(left, 6.0));
            visit(radius * std::cos(angle), radius * std::sin(angle), 6.0 * std::pow(left, 5.0) / (kRings * kTurns));
        }
}

/// Integrates over directions sampled by microfacets and by the shape, weighted by the balance heuristic.
ShapeFigures figuresOf(const ShapeView& view, const glm::dmat3& inverse) {
    const glm::dmat3 forwards = glm::inverse(inverse);
    const double determinant = glm::determinant(inverse);
    const auto shapeOf = [&](const glm::dvec3& light) {
        const glm::dvec3 cosine = inverse * light;
        return determinant * std::max(cosine.z, 0.0) / (std::numbers::pi * std::pow(glm::dot(cosine, cosine), 2.0));
    };
    const auto ofFacet = [&](double x, double y) {
        const double slope = view.alpha / std::sqrt(1.0 - x * x - y * y);
        const glm::dvec3 half = glm::normalize(glm::dvec3(slope * x, slope * y, 1.0)), viewer = view.viewer();
        const double cosine = glm::dot(viewer, half);
        return cosine > 0.0 ? 2.0 * cosine * half - viewer : glm::dvec3(0.0);
    };
    const auto ofShape = [&](double x, double y) {
        return glm::normalize(forwards * glm::dvec3(x, y, std::sqrt(1.0 - x * x - y * y)));
    };
    ShapeFigures figures;
    visitPlaces([&](double x, double y, double share) {
        const glm::dvec3 light = ofFacet(x, y);
        if (light.z > 0.0) figures.lobe += share * lobeOf(view, light) / facetDensity(view, light);
    });
    const auto visitBoth = [&](const auto& add) {
        visitPlaces([&](double x, double y, double share) {
            for (const glm::dvec3& light : {ofFacet(x, y), ofShape(x, y)})
                if (light.z > 0.0) add(light, share / (facetDensity(view, light) + shapeOf(light)));
        });
    };
    visitBoth([&](const glm::dvec3& light, double weight) { figures.share += weight * shapeOf(light); });
    visitBoth([&](const glm::dvec3& light, double weight) {
        figures.distance += weight * std::abs(lobeOf(view, light) / figures.lobe - shapeOf(light) / figures.share);
    });
    return figures;
}

double shapeDistance(double alpha, double cosView) {
    return figuresOf({alpha, cosView}, inverseShape(alpha, cosView)).distance;
}

double cosineOfDegrees(double degrees) {
    return degrees == 0.0 ? 1.0 : std::cos(degrees * std::numbers::pi / 180.0);
}

constexpr double kLastEntry = LOBE_SHAPES_SIDE - 1;

TEST(LobeShapes, areAsFarFromTheirLobesAsTheDocumentSays) {
    const std::vector<double> angles = {0.0, 30.0, 45.0, 60.0, 70.0, 80.0, 85.0, 89.0};
    std::vector<std::string> head = {"alpha"};
    for (const double degrees : angles) head.push_back(fmt::format("{}°", degrees));
    test::Rows rows;
    for (const double alpha : {0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
        std::vector<std::string>& row = rows.emplace_back();
        row.push_back(fmt::format("{}", alpha));
        for (const double degrees : angles)
            row.push_back(fmt::format("{:.3f}", shapeDistance(alpha, cosineOfDegrees(degrees))));
    }
    const std::string table = test::markdownTable(head, rows);
    EXPECT_TRUE(test::holdsTable(test::textOf(test::kRepository / "docs/area-lights.md"), table))
        << "docs/area-lights.md should hold exactly\n"
        << table;
}

TEST(LobeShapes, areAsGoodBetweenEntriesAsAtThem) {
    double atEntries = 0.0, between = 0.0;
    const auto squareOf = [](double place) { return place * place / (kLastEntry * kLastEntry); };
    for (int row = 1; row < LOBE_SHAPES_SIDE - 1; row += 3)
        for (int column = 0; column < LOBE_SHAPES_SIDE - 1; column += 3) {
            const auto at = [&](double rows, double columns) {
                return shapeDistance(std::max(squareOf(row + rows), 1e-3), std::max(squareOf(column + columns), 1e-4));
            };
            const double mean = 0.25 * (at(0.0, 0.0) + at(0.0, 1.0) + at(1.0, 0.0) + at(1.0, 1.0));
            const double middle = at(0.5, 0.5);
            // Lobes change fastest at the left end, where the viewer's cosine is less than alpha.
            EXPECT_LT(middle, 1.05 * mean + (column < 4 ? 0.05 : 0.003)) << row << ", " << column;
            atEntries += mean;
            between += middle;
        }
    EXPECT_LT(between, 1.01 * atEntries);
}

/// A small step in any of the four numbers reduces the distance by no more than the fit's tolerance. Some numbers of
/// narrow lobes hardly matter; only their neighbours constrain them (changeSmoothlyFromEntryToEntry).
TEST(LobeShapes, areNoFartherThanAStepAside) {
    constexpr double kStep = 0.02, kFitsEnd = 0.003;
    for (int row = 4; row < LOBE_SHAPES_SIDE; row += 9)
        for (int column = 1; column < LOBE_SHAPES_SIDE; column += 9) {
            const double alpha = row * row / (kLastEntry * kLastEntry);
            const double cosView = column * column / (kLastEntry * kLastEntry);
            const glm::vec4 own = lobeShapes()[std::size_t(row * LOBE_SHAPES_SIDE + column)];
            const auto distanceOf = [&](const glm::vec4& numbers) {
                const double sineView = std::sqrt(1.0 - cosView * cosView);
                const glm::dmat3 inverse =
                    shared::inverseOfShape(numbers, float(alpha), float(cosView), float(sineView));
                return figuresOf({alpha, cosView}, inverse).distance;
            };
            const double nearest = distanceOf(own);
            for (int i = 0; i < 4; ++i)
                for (const double step : {-kStep, kStep}) {
                    glm::vec4 aside = own;
                    aside[i] += float(step * std::max(1.0, std::abs(double(own[i]))));
                    EXPECT_GT(distanceOf(aside), nearest - kFitsEnd) << row << ", " << column << ", number " << i;
                }
        }
}

TEST(LobeShapes, holdTheShareAboveTheSurfaceThatTheClosedFormSays) {
    double least = 1.0;
    for (const double alpha : {1e-3, 0.01, 0.07, 0.2, 0.5, 1.0})
        for (const double degrees : {0.0, 20.0, 50.0, 75.0, 85.0, 89.0}) {
            const double cosine = cosineOfDegrees(degrees);
            const glm::dmat3 inverse = inverseShape(alpha, cosine);
            const double share = double(shared::shareAbove(glm::mat3(inverse)));
            EXPECT_NEAR(figuresOf({alpha, cosine}, inverse).share, share, 2e-3) << alpha << ", " << degrees;
            EXPECT_LE(share, 1.0);
            least = std::min(least, share);
        }
    EXPECT_GT(least, 0.93);
}

TEST(LobeShapes, areRoundAroundTheNormalWhereTheViewerIsThere) {
    for (int i = 0; i <= 100; ++i) {
        const glm::dmat3 inverse = inverseShape(i * i * 1e-4, 1.0);
        EXPECT_EQ(inverse[0].z, 0.0);
        EXPECT_EQ(inverse[2].x, 0.0);
        EXPECT_NEAR(inverse[0].x, inverse[1].y, 1e-6);
    }
}

TEST(LobeShapes, areFiniteInvertibleAndMirroredAtThePlaneOfTheViewer) {
    ASSERT_EQ(lobeShapes().size(), std::size_t(LOBE_SHAPES_SIDE) * LOBE_SHAPES_SIDE);
    for (const glm::vec4& numbers : lobeShapes())
        for (int i = 0; i < 4; ++i) ASSERT_LT(std::abs(numbers[i]), 4.0f);
    for (int i = 0; i <= 150; ++i)
        for (int j = 0; j <= 150; ++j) {
            const double alpha = i * i / 22500.0, cosine = j * j / 22500.0;
            const glm::dmat3 inverse = inverseShape(alpha, cosine);
            for (int k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(glm::dot(inverse[k], inverse[k])));
            // For small alpha the determinant is 2 alpha times the square of Smith's length.
            const double floored = std::max(alpha, 1e-3);
            const double width2 = floored * floored + (1.0 - floored * floored) * cosine * cosine;
            EXPECT_GT(glm::determinant(inverse), floored * width2) << alpha << ", " << cosine;
            EXPECT_EQ(inverse[0].y, 0.0);
            EXPECT_EQ(inverse[1], glm::dvec3(0.0, 1.0, 0.0));
            EXPECT_EQ(inverse[2].y, 0.0);
        }
}

TEST(LobeShapes, changeSmoothlyFromEntryToEntry) {
    const auto at = [](int row, int column) { return lobeShapes()[std::size_t(row * LOBE_SHAPES_SIDE + column)]; };
    // Entries fitted to different minima of one flat valley were off by 0.45.
    const auto expectNear = [](const glm::vec4& entry, const glm::vec4& before, const glm::vec4& after) {
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(entry[i], 0.5f * (before[i] + after[i]), 0.2f);
    };
    for (int row = 0; row < LOBE_SHAPES_SIDE; ++row)
        for (int column = 0; column < LOBE_SHAPES_SIDE; ++column) {
            SCOPED_TRACE(fmt::format("{}, {}", row, column));
            if (row > 0 && row < LOBE_SHAPES_SIDE - 1)
                expectNear(at(row, column), at(row - 1, column), at(row + 1, column));
            if (column > 0 && column < LOBE_SHAPES_SIDE - 1)
                expectNear(at(row, column), at(row, column - 1), at(row, column + 1));
        }
}

} // namespace
} // namespace tessera::frame
