#pragma once
#include <functional>

#include "scenes/Scene.h"
#include "scenes/builtin/Profile.h"

/// Procedural surfaces. Each function adds to a mesh: unit normals, texture coordinates in metres of surface (unless
/// stated otherwise) and triangles that run counter-clockwise seen from the side the normals point to.
namespace tessera::scenes::builtin {

struct SurfacePoint {
    glm::dvec3 positionOS{0.0};
    glm::dvec3 normalOS{0.0, 1.0, 0.0}; ///< of any length but 0
    glm::dvec2 texCoord{0.0};
};

/// The surface (u, v) -> point, 0..1 each, as a grid; triangles without area (at poles) are left out.
void appendPatch(Mesh& mesh, int stepsU, int stepsV, const std::function<SurfacePoint(double, double)>& surface);

/// A flat quadrangle, its corners counter-clockwise seen from the front.
void appendQuad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// An axis-aligned box with flat sides, facing outwards.
void appendBox(Mesh& mesh, const glm::dvec3& minOS, const glm::dvec3& maxOS);

/// A sphere with poles on Y and slice 0 at +X, (slices + 1) x (stacks + 1) vertices; texture coordinates 0..1.
void appendSphere(Mesh& mesh, const glm::dvec3& centerOS, double radiusMetres, int slices, int stacks);

/// A horizontal rectangle facing up, centred on `centerOS`, as a grid.
void appendFloor(Mesh& mesh, const glm::dvec3& centerOS, const glm::dvec2& sizeMetres, const glm::ivec2& steps);

/// A body of revolution about Y; the profile's x is the radius.
void appendLathe(Mesh& mesh, const Profile& profile, int slices);

/// The profile (x, y) extruded along Z from `fromZ` to `toZ`, as a moulding without end faces.
void appendMoulding(Mesh& mesh, const Profile& profile, double fromZ, double toZ);

/// The profile swept along a half circle in the XY plane about `centerOS`, from +X over +Y to -X: an arch. The
/// profile's x is the distance from the centre, its y runs along -Z.
void appendArch(Mesh& mesh, const Profile& profile, const glm::dvec3& centerOS, int steps);

/// A wall along X with a round-headed opening in its middle: front at z = 0 facing +Z, back at z = -depth, and the
/// opening's soffit between them.
struct ArchedWall {
    double widthMetres = 4.0;
    double bottomY = 0.0;
    double topY = 6.0;
    double halfOpeningMetres = 1.0; ///< also the radius of the round head
    double sillY = 0.0;             ///< == bottomY: the opening reaches the ground
    double springY = 3.0;           ///< where the round head begins
    double depthMetres = 0.5;
    bool back = true; ///< whether the back is visible
    bool soffit = true;
    int archSteps = 24;
};
void appendArchedWall(Mesh& mesh, const ArchedWall& wall);

/// Adds `part` moved by `meshFromPart` (any invertible affine matrix; mirrored parts keep their front outside).
void appendMesh(Mesh& mesh, const Mesh& part, const glm::dmat4& meshFromPart);

} // namespace tessera::scenes::builtin
