#include "validation/reference/SeenArea.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::reference {

using scenes::LightType;
using std::numbers::pi;

namespace {

using FlatCorners = std::array<glm::dvec2, 3>;

double crossOf(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Whether a place lies in a triangle or on its edge.
bool isInTriangle(const glm::dvec2& place, const FlatCorners& triangle) {
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double side = crossOf(triangle[(i + 1) % 3] - triangle[i], place - triangle[i]);
        left += side > 0.0;
        right += side < 0.0;
    }
    return left == 0 || right == 0;
}

} // namespace

/// Ear clipping: cuts off corners whose triangle with their neighbours holds no other corner. Every simple outline has
/// one (Meisters 1975, "Polygons have ears").
std::vector<FlatCorners> trianglesWithin(const scenes::LightCorners& corners) {
    std::vector<glm::dvec2> left(corners.all().begin(), corners.all().end());
    double turn = 0.0;
    for (std::size_t i = 0; i < left.size(); ++i) turn += crossOf(left[i], left[(i + 1) % left.size()]);
    if (turn < 0.0) std::ranges::reverse(left);
    std::vector<FlatCorners> triangles;
    while (left.size() > 3) {
        const std::size_t count = left.size();
        std::size_t ear = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const FlatCorners triangle{left[(i + count - 1) % count], left[i], left[(i + 1) % count]};
            const double bend = crossOf(triangle[1] - triangle[0], triangle[2] - triangle[1]);
            const auto isHeld = [&](const glm::dvec2& corner) {
                return std::ranges::find(triangle, corner) == triangle.end() && isInTriangle(corner, triangle);
            };
            // Corners on a straight line are dropped first, without a triangle.
            if (bend == 0.0 || (bend > 0.0 && std::ranges::none_of(left, isHeld))) {
                ear = i;
                if (bend != 0.0) triangles.push_back(triangle);
                break;
            }
        }
        left.erase(left.begin() + std::ptrdiff_t(ear));
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

static_assert(scenes::kAreaTypeCount == 5, "a new shape needs its patches, or it is dark");

SeenArea::SeenArea(const ShiningLight& shining, const glm::dvec3& positionRWS, const glm::dvec3& normal) {
    const scenes::Light& light = shining.light;
    const glm::dvec3 middle = shining.positionRWS - positionRWS;
    glm::dvec3 front = light.directionWS;
    const double radius = double(light.radiusMetres);
    bool isInPlane = false;
    if (scenes::infoOf(light.type).isFlat) {
        const double before = -glm::dot(middle, front);
        if (!(before > 0.0) && !light.isTwoSided) return;
        isInPlane = before == 0.0;
        if (before < 0.0 || (isInPlane && glm::dot(front, normal) < 0.0)) front = -front;
    }
    if (light.type == LightType::Rectangle) {
        const Frame frame{light.alongWS, glm::cross(light.directionWS, light.alongWS), front};
        patches_.push_back({Shape::Rectangle, middle, frame, {light.widthMetres, light.heightMetres}, 0.0, 1.0});
    } else if (light.type == LightType::Disk) {
        patches_.push_back({Shape::Disk, middle, frameOf(front), glm::dvec2(radius), 0.0, 1.0});
    } else if (light.type == LightType::Sphere) {
        addSphere(middle, radius);
    } else if (light.type == LightType::Tube) {
        addTube(middle, light);
    } else if (light.type == LightType::Polygon) {
        addPolygon(middle, light, front);
    }
    if (isInPlane) {
        // Taken as just in front of the plane: within the outline the light fills a hemisphere, elsewhere nothing.
        const bool isInOne = std::ranges::any_of(
            patches_, [](const Patch& patch) { return isWithin(patch, patch.frame.in(-patch.middle)); });
        patches_.clear();
        if (isInOne) patches_.push_back({Shape::Cone, middle, frameOf(-front), glm::dvec2(0.0), 1.0});
    }
    std::erase_if(patches_, [](const Patch& patch) { return !(patch.area() > 0.0); });
    double all = 0.0;
    for (const Patch& patch : patches_) all += patch.area();
    for (Patch& patch : patches_) patch.share = patch.area() / all;
}

void SeenArea::addSphere(const glm::dvec3& middle, double radiusMetres) {
    const double distance = glm::length(middle);
    if (!(distance > radiusMetres)) return;
    const double sine = radiusMetres / distance;
    const double opening = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
    patches_.push_back({Shape::Cone, middle, frameOf(middle / distance), glm::dvec2(radiusMetres), opening});
}

void SeenArea::addTube(const glm::dvec3& middle, const scenes::Light& light) {
    const double radius = double(light.radiusMetres), length = double(light.lengthMetres);
    const glm::dvec3& axis = light.directionWS;
    const double along = -glm::dot(middle, axis); // of the point along the axis, from the middle
    if (std::abs(along) > 0.5 * length) {
        const glm::dvec3 front = along < 0.0 ? -axis : axis;
        patches_.push_back({Shape::Disk, middle + 0.5 * length * front, frameOf(front), glm::dvec2(radius)});
    }
    const glm::dvec3 outwards = -middle - along * axis;
    const double away = glm::length(outwards);
    if (!(away > radius)) return;
    const glm::dvec3 towards = outwards / away;
    patches_.push_back({Shape::Mantle,
                        middle,
                        {glm::cross(axis, towards), axis, towards},
                        {radius, length},
                        std::acos(radius / away)});
}

void SeenArea::addPolygon(const glm::dvec3& middle, const scenes::Light& light, const glm::dvec3& front) {
    const Frame frame{light.alongWS, glm::cross(light.directionWS, light.alongWS), front};
    for (const FlatCorners& triangle : trianglesWithin(light.corners)) {
        Patch& patch = patches_.emplace_back();
        patch.shape = Shape::Triangle;
        patch.middle = middle + triangle[0].x * frame.x + triangle[0].y * frame.y;
        patch.frame = frame;
        patch.sides = {triangle[1] - triangle[0], triangle[2] - triangle[0]};
    }
}

double SeenArea::Patch::area() const {
    switch (shape) {
    case Shape::Rectangle:
        return sizeMetres.x * sizeMetres.y;
    case Shape::Disk:
        return pi * sizeMetres.x * sizeMetres.x;
    case Shape::Cone:
        return 2.0 * pi * opening;
    case Shape::Mantle:
        return 2.0 * opening * sizeMetres.x * sizeMetres.y;
    case Shape::Triangle:
        return 0.5 * std::abs(crossOf(sides[0], sides[1]));
    }
    return 0.0;
}

bool SeenArea::isRound(std::size_t patch) const {
    return patches_[patch].shape == Shape::Disk || patches_[patch].shape == Shape::Cone;
}

bool SeenArea::isFan(std::size_t patch) const {
    return isRound(patch) || patches_[patch].shape == Shape::Triangle;
}

SeenArea::Place SeenArea::at(std::size_t patchNumber, const glm::dvec2& square) const {
    const Patch& patch = patches_[patchNumber];
    const Frame& frame = patch.frame;
    const double turn = 2.0 * pi * square.y;
    // The area element grows with the distance from the middle or the first corner, whose mean is 1/2.
    const double ring = isFan(patchNumber) ? 2.0 * square.x : 1.0;
    if (patch.shape == Shape::Cone) {
        const double opened = patch.opening * square.x * square.x;
        const double sine = std::sqrt(opened * (2.0 - opened));
        return {frame.out({sine * std::cos(turn), sine * std::sin(turn), 1.0 - opened}), ring * patch.area()};
    }
    glm::dvec3 place = patch.middle, normal = frame.z;
    if (patch.shape == Shape::Rectangle) {
        const glm::dvec2 across = (square - 0.5) * patch.sizeMetres;
        place += across.x * frame.x + across.y * frame.y;
    } else if (patch.shape == Shape::Triangle) {
        const glm::dvec2 across = square.x * glm::mix(patch.sides[0], patch.sides[1], square.y);
        place += across.x * frame.x + across.y * frame.y;
    } else if (patch.shape == Shape::Disk) {
        place += square.x * patch.sizeMetres.x * (std::cos(turn) * frame.x + std::sin(turn) * frame.y);
    } else {
        const double angle = (2.0 * square.x - 1.0) * patch.opening;
        normal = std::cos(angle) * frame.z + std::sin(angle) * frame.x;
        place += patch.sizeMetres.x * normal + (square.y - 0.5) * patch.sizeMetres.y * frame.y;
    }
    const double distance2 = glm::dot(place, place);
    if (distance2 == 0.0) return {frame.z, 0.0};
    const glm::dvec3 direction = place / std::sqrt(distance2);
    return {direction, ring * patch.area() * std::max(-glm::dot(normal, direction), 0.0) / distance2};
}

glm::dvec3 SeenArea::direction(const glm::dvec2& random) const {
    double x = random.x;
    for (std::size_t patch = 0; patch < patches_.size(); ++patch) {
        const double share = patches_[patch].share;
        if (x < share || patch + 1 == patches_.size()) {
            const double u = std::clamp(x / share, 0.0, 1.0);
            return at(patch, {isFan(patch) ? std::sqrt(u) : u, random.y}).direction;
        }
        x -= share;
    }
    return {0.0, 0.0, 1.0};
}

double SeenArea::density(const glm::dvec3& direction) const {
    double sum = 0.0;
    for (const Patch& patch : patches_) sum += patch.share * density(patch, direction);
    return sum;
}

bool SeenArea::isWithin(const Patch& patch, const glm::dvec3& place) {
    if (patch.shape == Shape::Triangle)
        return isInTriangle(glm::dvec2(place), {glm::dvec2(0.0), patch.sides[0], patch.sides[1]});
    if (patch.shape == Shape::Rectangle)
        return std::abs(place.x) <= 0.5 * patch.sizeMetres.x && std::abs(place.y) <= 0.5 * patch.sizeMetres.y;
    return glm::length(glm::dvec2(place)) <= patch.sizeMetres.x;
}

double SeenArea::density(const Patch& patch, const glm::dvec3& direction) {
    const Frame& frame = patch.frame;
    if (patch.shape == Shape::Cone) {
        const glm::dvec3 aside = direction - frame.z;
        return 0.5 * glm::dot(aside, aside) <= patch.opening ? 1.0 / patch.area() : 0.0;
    }
    double distance = 0.0, cosine = 0.0;
    if (patch.shape == Shape::Mantle) {
        // Intersects the circle |t d - m| = radius in the plane across the axis, from the point.
        const glm::dvec3 d = frame.in(direction), m = frame.in(patch.middle);
        const glm::dvec2 flat(d.x, d.z), to(m.x, m.z);
        const double radius = patch.sizeMetres.x;
        const double a = glm::dot(flat, flat), b = glm::dot(flat, to), c = glm::dot(to, to) - radius * radius;
        const double inRoot = b * b - a * c;
        if (!(a > 0.0 && b > 0.0 && inRoot > 0.0)) return 0.0;
        distance = c / (b + std::sqrt(inRoot));
        if (std::abs(distance * d.y - m.y) > 0.5 * patch.sizeMetres.y) return 0.0;
        cosine = -glm::dot(flat, distance * flat - to) / radius;
    } else {
        cosine = -glm::dot(frame.z, direction);
        if (!(cosine > 0.0)) return 0.0;
        distance = -glm::dot(patch.middle, frame.z) / cosine;
        const glm::dvec3 place = frame.in(distance * direction - patch.middle);
        if (!isWithin(patch, place)) return 0.0;
    }
    return cosine > 0.0 ? distance * distance / (cosine * patch.area()) : 0.0;
}

} // namespace tessera::reference
