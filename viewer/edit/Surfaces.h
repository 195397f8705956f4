#pragma once
#include <vector>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// Places on the surfaces of a scene, as likely on any square metre as on any other.
class Surfaces {
public:
    explicit Surfaces(const scenes::Scene& scene);

    bool empty() const { return areaSums_.empty(); }
    double areaSquareMetres() const { return areaSums_.empty() ? 0.0 : areaSums_.back(); }

    struct Place {
        glm::dvec3 positionWS;
        glm::dvec3 normalWS; ///< of the triangle's front
    };
    /// The place that three numbers from 0 to 1 choose.
    Place at(double triangle, double u, double v) const;

private:
    struct Triangle {
        glm::dvec3 cornerWS, firstEdge, secondEdge;
    };
    std::vector<Triangle> triangles_;
    std::vector<double> areaSums_; ///< of the triangles up to each
};

} // namespace tessera::viewer
