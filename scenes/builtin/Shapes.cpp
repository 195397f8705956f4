#include "scenes/builtin/Shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace tessera::scenes::builtin {
namespace {

using std::numbers::pi;
/// Triangles with a smaller doubled area, in m^2, are degenerate, as at poles.
constexpr double kNoArea = 1e-9;

std::uint32_t appendVertex(Mesh& mesh, const SurfacePoint& point) {
    mesh.positionsOS.emplace_back(point.positionOS);
    mesh.normalsOS.emplace_back(glm::normalize(point.normalOS));
    mesh.texCoords[0].emplace_back(point.texCoord);
    return static_cast<std::uint32_t>(mesh.positionsOS.size() - 1);
}

/// Adds the triangle with its front on the side of the normals.
void appendTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec3 pa(mesh.positionsOS[a]);
    const glm::dvec3 frontOS = glm::cross(glm::dvec3(mesh.positionsOS[b]) - pa, glm::dvec3(mesh.positionsOS[c]) - pa);
    if (glm::length(frontOS) < kNoArea) return;
    const glm::dvec3 normalOS(mesh.normalsOS[a] + mesh.normalsOS[b] + mesh.normalsOS[c]);
    if (glm::dot(frontOS, normalOS) < 0.0) std::swap(b, c);
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// Sweeps the profile along frames that map its plane into space; `pathMetres` scales the texture coordinate along the
/// path.
void appendSweep(Mesh& mesh, const Profile& profile, int steps, double pathMetres,
                 const std::function<glm::dmat4(double)>& meshFromProfile) {
    double profileMetres = 0.0;
    for (const Profile::Run& run : profile.runs()) {
        std::vector<double> lengths = {profileMetres};
        for (std::size_t i = 1; i < run.points.size(); ++i) {
            lengths.push_back(lengths.back() + glm::distance(run.points[i - 1], run.points[i]));
        }
        profileMetres = lengths.back();
        const int runSteps = static_cast<int>(run.points.size()) - 1;
        appendPatch(mesh, steps, runSteps, [&](double u, double v) {
            const auto i = static_cast<std::size_t>(std::lround(v * runSteps));
            const glm::dmat4 frame = meshFromProfile(u);
            return SurfacePoint{glm::dvec3(frame * glm::dvec4(run.points[i], 0.0, 1.0)),
                                glm::dvec3(frame * glm::dvec4(run.normals[i], 0.0, 0.0)),
                                {u * pathMetres, -lengths[i]}};
        });
    }
}

} // namespace

void appendPatch(Mesh& mesh, int stepsU, int stepsV, const std::function<SurfacePoint(double, double)>& surface) {
    const auto first = static_cast<std::uint32_t>(mesh.positionsOS.size());
    for (int j = 0; j <= stepsV; ++j) {
        for (int i = 0; i <= stepsU; ++i) {
            appendVertex(mesh, surface(static_cast<double>(i) / stepsU, static_cast<double>(j) / stepsV));
        }
    }
    const auto row = static_cast<std::uint32_t>(stepsU + 1);
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(stepsV); ++j) {
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(stepsU); ++i) {
            const std::uint32_t a = first + j * row + i;
            appendTriangle(mesh, a, a + 1, a + row + 1);
            appendTriangle(mesh, a, a + row + 1, a + row);
        }
    }
}

void appendQuad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 normalOS = glm::cross(c - a, d - b);
    const double width = glm::distance(a, b);
    const double height = glm::distance(a, d);
    const std::uint32_t first = appendVertex(mesh, {a, normalOS, {0.0, height}});
    appendVertex(mesh, {b, normalOS, {width, height}});
    appendVertex(mesh, {c, normalOS, {width, 0.0}});
    appendVertex(mesh, {d, normalOS, {0.0, 0.0}});
    appendTriangle(mesh, first, first + 1, first + 2);
    appendTriangle(mesh, first, first + 2, first + 3);
}

void appendBox(Mesh& mesh, const glm::dvec3& lo, const glm::dvec3& hi) {
    appendQuad(mesh, {hi.x, lo.y, hi.z}, {hi.x, lo.y, lo.z}, {hi.x, hi.y, lo.z}, {hi.x, hi.y, hi.z});
    appendQuad(mesh, {lo.x, lo.y, lo.z}, {lo.x, lo.y, hi.z}, {lo.x, hi.y, hi.z}, {lo.x, hi.y, lo.z});
    appendQuad(mesh, {lo.x, hi.y, hi.z}, {hi.x, hi.y, hi.z}, {hi.x, hi.y, lo.z}, {lo.x, hi.y, lo.z});
    appendQuad(mesh, {lo.x, lo.y, lo.z}, {hi.x, lo.y, lo.z}, {hi.x, lo.y, hi.z}, {lo.x, lo.y, hi.z});
    appendQuad(mesh, {lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, hi.y, hi.z}, {lo.x, hi.y, hi.z});
    appendQuad(mesh, {hi.x, lo.y, lo.z}, {lo.x, lo.y, lo.z}, {lo.x, hi.y, lo.z}, {hi.x, hi.y, lo.z});
}

void appendSphere(Mesh& mesh, const glm::dvec3& centerOS, double radiusMetres, int slices, int stacks) {
    appendPatch(mesh, slices, stacks, [&](double u, double v) {
        const double longitude = 2.0 * pi * u;
        const double colatitude = pi * v;
        const glm::dvec3 outOS(std::sin(colatitude) * std::cos(longitude), std::cos(colatitude),
                               -std::sin(colatitude) * std::sin(longitude));
        return SurfacePoint{centerOS + radiusMetres * outOS, outOS, {u, v}};
    });
}

void appendFloor(Mesh& mesh, const glm::dvec3& centerOS, const glm::dvec2& sizeMetres, const glm::ivec2& steps) {
    appendPatch(mesh, steps.x, steps.y, [&](double u, double v) {
        const glm::dvec2 offset(sizeMetres.x * (u - 0.5), sizeMetres.y * (v - 0.5));
        return SurfacePoint{
            centerOS + glm::dvec3(offset.x, 0.0, offset.y), {0.0, 1.0, 0.0}, sizeMetres * glm::dvec2(u, v)};
    });
}

void appendLathe(Mesh& mesh, const Profile& profile, int slices) {
    double widest = 0.0;
    for (const Profile::Run& run : profile.runs()) {
        for (const glm::dvec2& point : run.points) widest = std::max(widest, point.x);
    }
    appendSweep(mesh, profile, slices, 2.0 * pi * widest, [](double u) {
        const double c = std::cos(2.0 * pi * u);
        const double s = std::sin(2.0 * pi * u);
        return glm::dmat4({c, 0.0, -s, 0.0}, {0.0, 1.0, 0.0, 0.0}, {s, 0.0, c, 0.0}, {0.0, 0.0, 0.0, 1.0});
    });
}

void appendMoulding(Mesh& mesh, const Profile& profile, double fromZ, double toZ) {
    appendSweep(mesh, profile, 1, std::abs(toZ - fromZ), [&](double u) {
        glm::dmat4 frame(1.0);
        frame[3].z = glm::mix(fromZ, toZ, u);
        return frame;
    });
}

void appendArch(Mesh& mesh, const Profile& profile, const glm::dvec3& centerOS, int steps) {
    const double radiusMetres = profile.runs().front().points.front().x;
    appendSweep(mesh, profile, steps, pi * radiusMetres, [&](double u) {
        const double c = std::cos(pi * u);
        const double s = std::sin(pi * u);
        return glm::dmat4({c, s, 0.0, 0.0}, {0.0, 0.0, -1.0, 0.0}, {-s, c, 0.0, 0.0}, glm::dvec4(centerOS, 1.0));
    });
}

void appendArchedWall(Mesh& mesh, const ArchedWall& wall) {
    const double half = wall.widthMetres / 2.0;
    const double open = wall.halfOpeningMetres;
    const auto outline = [&](double u) { // the round head, from its right end over the top to the left
        return glm::dvec2(open * std::cos(pi * u), wall.springY + open * std::sin(pi * u));
    };
    for (const double side : wall.back ? std::vector<double>{1.0, -1.0} : std::vector<double>{1.0}) {
        const double z = side > 0.0 ? 0.0 : -wall.depthMetres;
        const auto face = [&](double x, double y) {
            return SurfacePoint{{x, y, z}, {0.0, 0.0, side}, {side * x + half, -y}};
        };
        const auto rectangle = [&](double x0, double x1, double y0, double y1) {
            if (x1 <= x0 || y1 <= y0) return;
            appendPatch(mesh, 1, 1, [&](double u, double v) { return face(glm::mix(x0, x1, u), glm::mix(y0, y1, v)); });
        };
        rectangle(-half, -open, wall.bottomY, wall.topY);
        rectangle(open, half, wall.bottomY, wall.topY);
        rectangle(-open, open, wall.bottomY, wall.sillY);
        appendPatch(mesh, wall.archSteps, 1, [&](double u, double v) {
            const glm::dvec2 arch = outline(u);
            return face(arch.x, glm::mix(arch.y, wall.topY, v));
        });
    }
    if (!wall.soffit) return;
    appendPatch(mesh, wall.archSteps, 1, [&](double u, double v) {
        const glm::dvec2 arch = outline(u);
        const glm::dvec3 inwards(-std::cos(pi * u), -std::sin(pi * u), 0.0);
        return SurfacePoint{{arch.x, arch.y, -v * wall.depthMetres}, inwards, {pi * open * u, v * wall.depthMetres}};
    });
    for (const double side : {-1.0, 1.0}) {
        appendPatch(mesh, 1, 1, [&](double u, double v) {
            const double y = glm::mix(wall.sillY, wall.springY, u);
            return SurfacePoint{{side * open, y, -v * wall.depthMetres}, {-side, 0.0, 0.0}, {v * wall.depthMetres, -y}};
        });
    }
    if (wall.sillY <= wall.bottomY) return;
    appendPatch(mesh, 1, 1, [&](double u, double v) {
        const double x = glm::mix(-open, open, u);
        return SurfacePoint{{x, wall.sillY, -v * wall.depthMetres}, {0.0, 1.0, 0.0}, {x, v * wall.depthMetres}};
    });
}

void appendMesh(Mesh& mesh, const Mesh& part, const glm::dmat4& meshFromPart) {
    const glm::dmat3 linear(meshFromPart);
    const double orientation = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
    // The cofactor matrix transforms normals, up to a factor: positive for proper, negative for mirroring matrices.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const auto first = static_cast<std::uint32_t>(mesh.positionsOS.size());
    for (std::size_t i = 0; i < part.positionsOS.size(); ++i) {
        appendVertex(mesh,
                     {glm::dvec3(meshFromPart * glm::dvec4(glm::dvec3(part.positionsOS[i]), 1.0)),
                      orientation * (cofactors * glm::dvec3(part.normalsOS[i])), glm::dvec2(part.texCoords[0][i])});
    }
    for (std::size_t i = 0; i < part.indices.size(); i += 3) {
        const std::uint32_t a = first + part.indices[i];
        const std::uint32_t b = first + part.indices[i + 1];
        const std::uint32_t c = first + part.indices[i + 2];
        if (orientation > 0.0) {
            mesh.indices.insert(mesh.indices.end(), {a, b, c});
        } else {
            mesh.indices.insert(mesh.indices.end(), {a, c, b});
        }
    }
}

} // namespace tessera::scenes::builtin
