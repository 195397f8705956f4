#pragma once
#include <vector>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// Uniformly distributed points on the surfaces of a scene.
class Surfaces {
public:
    explicit Surfaces(const scenes::Scene& scene);

    bool empty() const { return areaSums_.empty(); }
    double areaSquareMetres() const { return areaSums_.empty() ? 0.0 : areaSums_.back(); }

    struct Place {
        glm::dvec3 positionWS;
        glm::dvec3 normalWS; ///< of the triangle's front
    };
    /// The point for three uniform numbers from 0 to 1.
    Place at(double triangle, double u, double v) const;

private:
    struct Triangle {
        glm::dvec3 cornerWS, firstEdge, secondEdge;
    };
    std::vector<Triangle> triangles_;
    std::vector<double> areaSums_; ///< prefix sums over the triangles
};

} // namespace tessera::viewer
