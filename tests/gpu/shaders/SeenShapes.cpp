#include "tests/gpu/shaders/SeenShapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "renderer/frame/LightPictures.h"
#include "shaders/shared/light.h"

namespace tessera::test {
namespace {

using scenes::LightType;
using std::numbers::pi;

/// Twice the area within the corners, in units of their coordinates.
double twiceAreaOf(const std::vector<glm::vec2>& corners) {
    double twice = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a(corners[i]), b(corners[(i + 1) % corners.size()]);
        twice += a.x * b.y - a.y * b.x;
    }
    return twice;
}

/// The outline as LightCornerTexels, and its area as a fraction of the product of both vectors.
struct PackedOutline {
    std::array<glm::vec4, LIGHT_CORNER_TEXELS> texels{}; // without its triangles, which only shadows need
    float areaShare = 0.0f;
};

PackedOutline packedOutline(const std::vector<glm::vec2>& corners) {
    PackedOutline packed;
    if (corners.empty()) return packed;
    const double twice = twiceAreaOf(corners);
    glm::dvec2 middle(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a(corners[i]), b(corners[(i + 1) % corners.size()]);
        middle += (a.x * b.y - a.y * b.x) * (a + b) / (3.0 * twice);
        glm::vec4& two = packed.texels[1 + i / 2];
        (i % 2 == 0 ? two.x : two.z) = corners[i].x;
        (i % 2 == 0 ? two.y : two.w) = corners[i].y;
    }
    packed.texels[0] = glm::vec4(glm::vec2(middle), float(corners.size()), 0.0f);
    packed.areaShare = float(0.5 * twice);
    return packed;
}

/// Density of a lobe: the fraction that a surface element covers, per its area times the distance of its plane.
class LobeDensity {
public:
    explicit LobeDensity(const glm::mat3& matrix) : matrix_(matrix) {
        const glm::dvec3 horizon = glm::cross(matrix_[0], matrix_[1]);
        scale_ = std::abs(glm::determinant(matrix_)) / pi / (0.5 + 0.5 * horizon.z / glm::length(horizon));
    }
    double at(const glm::dvec3& place) const {
        const glm::dvec3 seen = matrix_ * place;
        if (!(place.z > 0.0 && seen.z > 0.0)) return 0.0;
        return scale_ * seen.z / (glm::dot(seen, seen) * glm::dot(seen, seen));
    }

private:
    glm::dmat3 matrix_;
    double scale_;
};

/// Integral over the square -1..1 x -1..1, by `columns` x `rows` cells of 4 x 4 Gauss points.
template <typename Value>
double overSquare(int columns, int rows, const Value& value) {
    constexpr double kPlaces[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
    constexpr double kWeights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
    double sum = 0.0;
    for (int i = 0; i < columns * 4; ++i)
        for (int j = 0; j < rows * 4; ++j)
            sum += kWeights[i % 4] * kWeights[j % 4] *
                   value((2 * (i / 4) + 1 + kPlaces[i % 4]) / columns - 1.0,
                         (2 * (j / 4) + 1 + kPlaces[j % 4]) / rows - 1.0);
    return sum / (columns * rows);
}

/// Integral over a polygon: a sum of signed triangles from the first corner.
template <typename Value>
double overPolygon(const std::vector<glm::vec2>& corners, const Value& value) {
    double sum = 0.0;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const glm::dvec2 from = corners[0], a = glm::dvec2(corners[i - 1]) - from, b = glm::dvec2(corners[i]) - from;
        sum += 0.25 * (a.x * b.y - a.y * b.x) * overSquare(50, 50, [&](double x, double y) {
                   const double along = 0.5 + 0.5 * x;
                   const glm::dvec2 at = from + along * glm::mix(a, b, 0.5 + 0.5 * y);
                   return along * value(at.x, at.y);
               });
    }
    return sum;
}

/// Integral over the unit disk, whose coordinates are in units of a disk's two vectors.
template <typename Value>
double overDisk(const Value& value) {
    return overSquare(10, 20, [&](double x, double y) {
        const double along = 0.5 + 0.5 * x, angle = pi * y;
        return 0.5 * pi * along * value(along * std::cos(angle), along * std::sin(angle));
    });
}

double shareOfTube(const SeenShape& shape, const LobeDensity& density) {
    const glm::dvec3 middle(shape.middle), first(shape.first);
    const double radius = double(shape.radius), half = glm::length(first);
    const glm::dvec3 axis = first / half;
    const double along = -glm::dot(middle, axis);
    const glm::dvec3 outwards = -middle - along * axis;
    const double away = glm::length(outwards);
    const glm::dvec3 right = outwards / away, up = glm::cross(axis, right);
    double share = 0.0;
    if (away > radius) {
        const double seenHalf = std::acos(radius / away);
        share += overSquare(100, 10, [&](double x, double y) {
            const glm::dvec3 normal = std::cos(seenHalf * y) * right + std::sin(seenHalf * y) * up;
            const glm::dvec3 place = middle + x * first + radius * normal;
            return half * seenHalf * radius * std::max(-glm::dot(place, normal), 0.0) * density.at(place);
        });
    }
    const double beyond = std::abs(along) - half;
    const glm::dvec3 end = middle + (along > 0.0 ? first : -first);
    if (beyond > 0.0)
        share += radius * radius * beyond *
                 overDisk([&](double x, double y) { return density.at(end + radius * (x * right + y * up)); });
    return share;
}

} // namespace

const std::array<glm::mat3, 3> kCosineMatrices{
    glm::mat3(1.0f), glm::mat3(glm::vec3(0.3f, 0.0f, 0.1f), glm::vec3(0, 1, 0), glm::vec3(-0.4f, 0.0f, 0.35f)),
    glm::mat3(glm::vec3(0.02f, 0.0f, 0.001f), glm::vec3(0.0f, 0.05f, 0.0f), glm::vec3(0.03f, 0.0f, 1.0f))};

double shareByQuadrature(const SeenShape& shape, const glm::mat3& cosineFromSurface) {
    if (shape.type == LightType::Tube) return shareOfTube(shape, LobeDensity(cosineFromSurface));
    return shareByQuadrature(shape, cosineFromSurface, [](double, double) { return 1.0; });
}

double shareByQuadrature(const SeenShape& shape, const glm::mat3& cosineFromSurface,
                         const std::function<double(double, double)>& factor) {
    const LobeDensity density(cosineFromSurface);
    const glm::dvec3 middle(shape.middle), first(shape.first), second(shape.second);
    const auto value = [&](double x, double y) { return factor(x, y) * density.at(middle + x * first + y * second); };
    const double facing = std::abs(glm::dot(middle, glm::cross(first, second)));
    if (shape.type == LightType::Polygon) return facing * overPolygon(shape.corners, value);
    return facing * (shape.type == LightType::Disk ? overDisk(value) : overSquare(100, 10, value));
}

std::vector<SeenByShader> seenByShader(ShaderBench& bench, const std::vector<SeenShape>& shapes,
                                       const glm::mat3& cosineFromSurface) {
    std::vector<glm::vec4> inputs;
    for (const SeenShape& shape : shapes) {
        const PackedOutline outline = packedOutline(shape.corners);
        const float radius = shape.type == LightType::Polygon ? outline.areaShare : shape.radius;
        inputs.insert(inputs.end(), {{shape.middle, float(int(shape.type))},
                                     {shape.first, radius},
                                     {shape.second, frame::packSides(shape.isTwoSided, shape.picture)}});
        inputs.insert(inputs.end(), outline.texels.begin(), outline.texels.end());
        for (int column = 0; column < 3; ++column) inputs.emplace_back(cosineFromSurface[column], 0.0f);
    }
    shader::Defines defines = frame::featureDefines(frame::allFeatures());
    defines.emplace_back("ENVIRONMENT_COMPENSATION", "0");
    const std::vector<glm::vec4> outputs = bench.run("test/seen_shapes.comp", defines, inputs, shapes.size(), 2);
    std::vector<SeenByShader> seen;
    for (std::size_t i = 0; i < shapes.size(); ++i)
        seen.push_back({double(outputs[2 * i].x), glm::dvec3(outputs[2 * i + 1])});
    return seen;
}

} // namespace tessera::test
