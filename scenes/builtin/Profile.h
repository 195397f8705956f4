#pragma once
#include <vector>

#include <glm/glm.hpp>

namespace tessera::scenes::builtin {

/// An outline in a plane, for bodies of revolution and mouldings: smooth runs that meet in sharp edges. Seen along the
/// direction of travel the outside lies to the right (an outline around the Y axis is drawn upwards).
class Profile {
public:
    struct Run {
        std::vector<glm::dvec2> points;
        std::vector<glm::dvec2> normals; ///< unit, outwards
    };

    explicit Profile(const glm::dvec2& start) : pen_(start) {}

    /// A straight run.
    Profile& lineTo(const glm::dvec2& end);
    /// A circular run about `center` through `turnRadians` (positive: counter-clockwise) in `steps`.
    Profile& arcAround(const glm::dvec2& center, double turnRadians, int steps);
    /// A run through `points` as a Catmull-Rom spline (Catmull and Rom 1974), `steps` between two of them.
    Profile& curveThrough(const std::vector<glm::dvec2>& points, int steps);

    const std::vector<Run>& runs() const { return runs_; }

private:
    glm::dvec2 pen_;
    std::vector<Run> runs_;
};

} // namespace tessera::scenes::builtin
