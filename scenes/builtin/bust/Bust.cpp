#include "scenes/builtin/bust/Bust.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <tbb/parallel_for.h>

#include "scenes/builtin/Noise.h"
#include "scenes/builtin/Pictures.h"
#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/bust/BustField.h"

namespace tessera::scenes::builtin {
namespace {

using std::numbers::pi;

/// Origins and elevations of rays towards the skin, by height on the bust: level through the shoulders and neck,
/// fanning out around the skull, so that every ray hits the skin once and no quad is stretched under the chin.
struct RayKnot {
    double up; ///< 0 at the bottom, 1 at the crown
    double originY;
    double originZ;
    double elevationDegrees;
};
constexpr double kFootZ = -0.32; // the axis of the foot
constexpr std::array kRayKnots = {RayKnot{0.0, kBustBottomY, kFootZ, 0.0}, RayKnot{0.1, -2.6, kFootZ, 0.0},
                                  RayKnot{0.3, -1.45, -0.36, 0.0},         RayKnot{0.4, -0.95, -0.3, -20.0},
                                  RayKnot{0.46, -0.6, -0.2, -33.0},        RayKnot{0.75, 0.05, -0.1, 3.0},
                                  RayKnot{0.85, 0.2, -0.12, 32.0},         RayKnot{1.0, 0.3, -0.16, 90.0}};

struct Ray {
    glm::dvec3 originBU;
    glm::dvec3 directionBU;
};

Ray rayTowardsSkin(double around, double up) {
    std::size_t i = 0;
    while (i + 2 < kRayKnots.size() && up > kRayKnots[i + 1].up) ++i;
    const RayKnot& a = kRayKnots[i];
    const RayKnot& b = kRayKnots[i + 1];
    const double t = (up - a.up) / (b.up - a.up);
    // More columns in front: the longitude grows slower there. u = 0 and 1 lie at the back.
    const double longitude = 2.0 * pi * (around - 0.5) - 0.55 * std::sin(2.0 * pi * (around - 0.5));
    // Rays descend only at the chin; at the sides they would graze the shoulders.
    double elevationDegrees = glm::mix(a.elevationDegrees, b.elevationDegrees, t);
    if (elevationDegrees < 0.0) elevationDegrees *= 0.5 + 0.5 * std::cos(longitude);
    const double elevation = glm::radians(elevationDegrees);
    return {
        {0.0, glm::mix(a.originY, b.originY, t), glm::mix(a.originZ, b.originZ, t)},
        {std::cos(elevation) * std::sin(longitude), std::sin(elevation), std::cos(elevation) * std::cos(longitude)}};
}

/// Distance along the ray to the outermost point of the skin. The march starts from `guess` if that lies a little
/// outside, else from beyond the shoulders; then the crossing is narrowed by false position (the Illinois variant,
/// Dowell and Jarratt 1971).
double skinAlong(const Ray& ray, double guess) {
    constexpr double kOutside = 2.6;
    constexpr double kCaution = 0.7; // fillets make the field steeper than a distance in places
    constexpr double kShortestStep = 0.004;
    const auto field = [&](double along) { return bustField(ray.originBU + along * ray.directionBU); };
    double far = guess + 0.12;
    double farValue = field(far);
    if (farValue <= 0.0 || farValue > 0.3) {
        far = kOutside;
        farValue = field(far);
    }
    double near = far;
    double nearValue = farValue;
    while (nearValue > 0.0 && near > 0.0) {
        far = near;
        farValue = nearValue;
        near -= std::max(kCaution * nearValue, kShortestStep);
        nearValue = field(near);
    }
    for (int i = 0; i < 8 && far - near > 1e-6; ++i) {
        const double middle = near + (far - near) * nearValue / (nearValue - farValue);
        const double value = field(middle);
        if (value > 0.0) {
            far = middle;
            farValue = value;
            nearValue *= 0.5;
        } else {
            near = middle;
            nearValue = value;
            farValue *= 0.5;
        }
    }
    return 0.5 * (near + far);
}

/// Gradient from four samples of the field at a tetrahedron's corners.
glm::dvec3 fieldGradient(const glm::dvec3& p) {
    constexpr double kStep = 0.006; // a little under the finest feature of the field
    static constexpr std::array<glm::dvec3, 4> kCorners = {
        {{1.0, -1.0, -1.0}, {-1.0, -1.0, 1.0}, {-1.0, 1.0, -1.0}, {1.0, 1.0, 1.0}}};
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : kCorners) sum += bustField(p + kStep * corner) * corner;
    return sum / (4.0 * kStep);
}

/// The skin on a grid over (u, v): points in bust units and unit normals, for meshes and for textures to interpolate.
struct Skin {
    int columns;
    int rows;
    std::vector<glm::dvec3> pointsBU;
    std::vector<glm::dvec3> normals;

    Skin(int columnCount, int rowCount) : columns(columnCount), rows(rowCount) {
        pointsBU.resize(at(0, rows + 1));
        normals.resize(pointsBU.size());
        tbb::parallel_for(0, columns, [&](int i) {
            double along = 0.0;
            for (int j = 0; j <= rows; ++j) {
                const Ray ray = rayTowardsSkin(static_cast<double>(i) / columns, 1.0 - static_cast<double>(j) / rows);
                along = skinAlong(ray, along);
                pointsBU[at(i, j)] = ray.originBU + along * ray.directionBU;
                normals[at(i, j)] = glm::normalize(fieldGradient(pointsBU[at(i, j)]));
            }
        });
        // The last column equals the first bit for bit, so that the seam is closed.
        for (int j = 0; j <= rows; ++j) {
            pointsBU[at(columns, j)] = pointsBU[at(0, j)];
            normals[at(columns, j)] = normals[at(0, j)];
        }
    }

    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(i);
    }

    glm::dvec3 interpolated(const std::vector<glm::dvec3>& values, double u, double v) const {
        const int i = std::min(static_cast<int>(u * columns), columns - 1);
        const int j = std::min(static_cast<int>(v * rows), rows - 1);
        const double s = u * columns - i;
        const double t = v * rows - j;
        return glm::mix(glm::mix(values[at(i, j)], values[at(i + 1, j)], s),
                        glm::mix(values[at(i, j + 1)], values[at(i + 1, j + 1)], s), t);
    }
};

/// Turns a normal until it points to the front of all faces: in a sharp crease the mean of the faces' normals may point
/// away from a small face.
glm::dvec3 towardsAll(glm::dvec3 normal, const std::vector<glm::dvec3>& faces) {
    constexpr double kLeastCosine = 0.05;
    constexpr int kMostTurns = 32;
    for (int turn = 0; turn < kMostTurns; ++turn) {
        glm::dvec3 worst = normal;
        for (const glm::dvec3& face : faces) {
            const double length = glm::length(face);
            if (length > 0.0 && glm::dot(face, normal) < length * glm::dot(worst, normal)) worst = face / length;
        }
        if (glm::dot(worst, normal) >= kLeastCosine) break;
        normal = glm::normalize(normal + 0.25 * worst);
    }
    return normal;
}

/// The skin's mesh, of every `stride`th point. Its normals are the mean of the faces around each vertex, weighted by
/// their areas: the normal map holds the relief between the vertices.
Mesh meshOf(const Skin& skin, int stride, double heightMetres) {
    const double metresPerUnit = heightMetres / (kBustTopY - kBustBottomY);
    const glm::dvec3 footBU(0.0, kBustBottomY, kFootZ);
    const int columns = skin.columns / stride;
    const int rows = skin.rows / stride;
    const auto point = [&](int i, int j) {
        return skin.pointsBU[skin.at(stride * ((i + columns) % columns), stride * j)];
    };
    const auto normal = [&](int i, int j) {
        if (j == 0) return glm::dvec3(0.0, 1.0, 0.0); // the crown, where all columns meet
        std::vector<glm::dvec3> faces;                // twice their areas long, outwards
        glm::dvec3 sum(0.0);
        for (int row = std::max(j - 1, 0); row < std::min(j + 1, rows); ++row) {
            for (int column = i - 1; column <= i; ++column) {
                const glm::dvec3 diagonal = point(column + 1, row + 1) - point(column, row);
                faces.push_back(glm::cross(diagonal, point(column + 1, row) - point(column, row)));
                faces.push_back(glm::cross(point(column, row + 1) - point(column, row), diagonal));
                sum += faces[faces.size() - 2] + faces.back();
            }
        }
        return towardsAll(glm::normalize(sum), faces);
    };
    Mesh mesh;
    appendPatch(mesh, columns, rows, [&](double u, double v) {
        const int i = static_cast<int>(std::lround(u * columns));
        const int j = static_cast<int>(std::lround(v * rows));
        return SurfacePoint{metresPerUnit * (point(i, j) - footBU), normal(i, j), {u, v}};
    });
    return mesh;
}

/// The skin and its relief at each texel of a map.
struct SkinMap {
    int size;
    std::vector<glm::dvec3> pointsBU;
    std::vector<glm::dvec3> normals;
    std::vector<double> heightsBU;

    SkinMap(const Skin& skin, int sizeTexels, double grain) : size(sizeTexels) {
        pointsBU.resize(at(0, size));
        normals.resize(pointsBU.size());
        heightsBU.resize(pointsBU.size());
        tbb::parallel_for(0, size, [&](int y) {
            for (int x = 0; x < size; ++x) {
                const double u = (x + 0.5) / size;
                const double v = (y + 0.5) / size;
                pointsBU[at(x, y)] = skin.interpolated(skin.pointsBU, u, v);
                normals[at(x, y)] = glm::normalize(skin.interpolated(skin.normals, u, v));
                heightsBU[at(x, y)] = bustRelief(pointsBU[at(x, y)], grain);
            }
        });
    }

    /// Columns wrap around the bust; rows end at the top and bottom.
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
               static_cast<std::size_t>((x + size) % size);
    }

    /// The normal of the skin raised by its relief: n - (surface gradient of the height), from the differences to the
    /// neighbouring texels and the metric they are taken in.
    glm::dvec3 reliefNormal(int x, int y) const {
        const int above = std::max(y - 1, 0);
        const int below = std::min(y + 1, size - 1);
        const glm::dvec3 n = normals[at(x, y)];
        const glm::dvec3 du = pointsBU[at(x + 1, y)] - pointsBU[at(x - 1, y)];
        const glm::dvec3 dv = pointsBU[at(x, below)] - pointsBU[at(x, above)];
        const double hu = heightsBU[at(x + 1, y)] - heightsBU[at(x - 1, y)];
        const double hv = heightsBU[at(x, below)] - heightsBU[at(x, above)];
        const double uu = glm::dot(du, du);
        const double uv = glm::dot(du, dv);
        const double vv = glm::dot(dv, dv);
        const double determinant = uu * vv - uv * uv;
        if (determinant < 1e-6 * uu * vv || uu * vv == 0.0) return n; // at the crown all columns meet
        const glm::dvec3 slope = ((hu * vv - hv * uv) * du + (hv * uu - hu * uv) * dv) / determinant;
        return glm::normalize(n - (slope - glm::dot(slope, n) * n));
    }
};

/// Linear colour of weathered marble: warm white, veined, darker where dust gathers.
glm::dvec3 marble(const glm::dvec3& pointBU, double heightBU) {
    constexpr glm::dvec3 kStone(0.66, 0.60, 0.51);
    constexpr glm::dvec3 kVein(0.36, 0.33, 0.31);
    constexpr glm::dvec3 kDust(0.20, 0.135, 0.085);
    constexpr glm::dvec3 kHair(0.47, 0.36, 0.25);
    constexpr glm::dvec3 kLips(0.58, 0.38, 0.31);
    const BustRegions regions = bustRegions(pointBU);
    const double cloud = fractalNoise(2.2 * pointBU, 3, 17);
    const double vein = std::exp(-std::pow(14.0 * fractalNoise(1.1 * pointBU + 0.35 * cloud, 3, 19), 2.0));
    glm::dvec3 color = kStone * (1.0 + 0.12 * cloud);
    color = glm::mix(color, kVein, 0.4 * vein);
    color = glm::mix(color, kHair, 0.75 * regions.hair);
    color = glm::mix(color, kLips, 0.45 * regions.lips);
    color = glm::mix(color, kHair, 0.5 * regions.brow);
    const double hollow = std::clamp(-heightBU / 0.012, 0.0, 1.0);
    return glm::mix(color, kDust, 0.7 * hollow);
}

/// White stone with grey veins, as it comes from the quarry.
glm::dvec3 polishedMarble(const glm::dvec3& pointBU) {
    constexpr glm::dvec3 kVein(0.30, 0.315, 0.34);
    const double cloud = fractalNoise(1.3 * pointBU, 4, 23);
    const double broad = std::exp(-std::pow(9.0 * fractalNoise(0.8 * pointBU + 0.5 * cloud, 4, 29), 2.0));
    const double thin = std::exp(-std::pow(22.0 * fractalNoise(1.9 * pointBU + 0.4 * cloud, 3, 31), 2.0));
    glm::dvec3 color = kPolishedMarble * (1.0 + 0.08 * cloud);
    color = glm::mix(color, kVein, 0.55 * broad);
    return glm::mix(color, kVein, 0.35 * thin);
}

/// Linear colour of skin: redder where blood is near, with brown hair and eyes.
glm::dvec3 skinColor(const glm::dvec3& pointBU, double heightBU) {
    constexpr glm::dvec3 kSkin(0.60, 0.36, 0.255), kBlood(0.56, 0.21, 0.155);
    constexpr glm::dvec3 kHair(0.075, 0.042, 0.024), kLips(0.46, 0.16, 0.135);
    constexpr glm::dvec3 kEye(0.66, 0.62, 0.57), kIris(0.11, 0.065, 0.035), kPupil(0.012);
    const BustRegions regions = bustRegions(pointBU);
    // Cheeks, tip of the nose and ears.
    const auto around = [&](const glm::dvec3& middle, double radius) {
        const glm::dvec3 offset = (pointBU - middle) / radius;
        return std::exp(-glm::dot(offset, offset));
    };
    const double blood = std::min(1.0, around({0.48, -0.35, 0.85}, 0.3) + around({-0.48, -0.35, 0.85}, 0.3) +
                                           around({0.0, -0.3, 1.25}, 0.2) + around({0.85, -0.1, 0.0}, 0.3) +
                                           around({-0.85, -0.1, 0.0}, 0.3));
    glm::dvec3 color = kSkin * (1.0 + 0.1 * fractalNoise(3.0 * pointBU, 4, 37));
    color = glm::mix(color, kBlood, std::clamp(0.42 * blood + 0.12 * fractalNoise(9.0 * pointBU, 3, 41), 0.0, 1.0));
    color = glm::mix(color, kLips, 0.7 * regions.lips);
    color = glm::mix(color, kHair, 0.9 * regions.brow);
    color = glm::mix(color, kHair, regions.hair);
    color = glm::mix(color, kEye, regions.eye);
    color = glm::mix(color, kIris, std::max(regions.iris, 0.6 * regions.irisRim));
    color = glm::mix(color, kPupil, regions.pupil);
    const double hollow = std::clamp(-heightBU / 0.02, 0.0, 1.0);
    return color * (1.0 - 0.25 * hollow);
}

glm::dvec3 painted(BustPaint paint, const glm::dvec3& pointBU, double heightBU) {
    switch (paint) {
    case BustPaint::PolishedMarble:
        return polishedMarble(pointBU);
    case BustPaint::Skin:
        return skinColor(pointBU, heightBU);
    case BustPaint::WeatheredMarble:
        break;
    }
    return marble(pointBU, heightBU);
}

} // namespace

Mesh bustMesh(int columns, int rows, double heightMetres) {
    return meshOf(Skin(columns, rows), 1, heightMetres);
}

Bust makeBust(int columns, int rows, double heightMetres, int mapTexels, BustPaint paint) {
    constexpr double kPores = 0.35; // fraction of the stone's grain
    constexpr int kMapStride = 2;   // the maps sample the sculpture twice as finely as the mesh
    const Skin skin(kMapStride * columns, kMapStride * rows);
    const SkinMap map(skin, mapTexels, paint == BustPaint::Skin ? kPores : 1.0);
    Bust bust;
    bust.mesh = meshOf(skin, kMapStride, heightMetres);
    bust.normalMap =
        drawNormals("bust normals", mapTexels, mapTexels, [&](int x, int y) { return map.reliefNormal(x, y); });
    bust.albedoMap = drawColors("bust albedo", mapTexels, mapTexels, [&](int x, int y) {
        return painted(paint, map.pointsBU[map.at(x, y)], map.heightsBU[map.at(x, y)]);
    });
    return bust;
}

} // namespace tessera::scenes::builtin
