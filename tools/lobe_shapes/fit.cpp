// Fits the shapes of GGX lobes, as linearly transformed cosines, in minutes on one core (docs/area-lights.md):
//     cmake --build --preset release --target lobe_shapes
// which runs `tessera_lobe_shapes renderer/frame/lobe_shapes.inc`. Source: Heitz, Dupuy, Hill, Neubelt 2016, "Real-Time
// Polygonal-Light Shading with Linearly Transformed Cosines"; differences are noted where they occur.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlopt.hpp>

#include "shaders/shared/lobe_shapes.h"

namespace {

using std::numbers::pi;

constexpr int kSide = LOBE_SHAPES_SIDE;
constexpr int kSamples = 2584, kShapeSamples = 1597; ///< per lobe and per shape
constexpr double kGrading = 4.0; ///< denser at the disc's rim, which few long steps map far from the centre

/// GGX alpha, and a direction to the viewer in the xz plane.
struct View {
    double alpha = 1.0, cosine = 1.0, sine = 0.0;
    double width = 1.0; ///< Smith's length of the view direction

    View(double ofAlpha, double cosView)
        : alpha(ofAlpha), cosine(cosView), sine(std::sqrt(1.0 - cosView * cosView)), width(smithLength(cosView)) {}
    double smithLength(double c) const { return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * c * c); }
};

/// Densities in 1/sr.
struct Densities {
    double brdfCosine = 0.0; ///< GGX without Fresnel, times the light's cosine
    double visible = 0.0;    ///< of reflections at visible microfacets; integrates to 1 over the sphere
};

Densities densitiesAt(const View& view, const glm::dvec3& light) {
    const glm::dvec3 sum = light + glm::dvec3(view.sine, 0.0, view.cosine);
    if (!(sum.z > 0.0)) return {};
    const double across = sum.x * sum.x + sum.y * sum.y, alpha2 = view.alpha * view.alpha;
    const double ratio = (across + sum.z * sum.z) / (alpha2 * sum.z * sum.z + across);
    const double distribution = alpha2 * ratio * ratio / pi;
    Densities densities;
    densities.visible = distribution / (2.0 * (view.cosine + view.width));
    if (light.z > 0.0)
        densities.brdfCosine =
            distribution * light.z / (2.0 * (light.z * view.width + view.cosine * view.smithLength(light.z)));
    return densities;
}

struct Place {
    glm::dvec2 disc;
    double share = 0.0;
};

/// Points in the half y > 0 of a unit disc, and their area fractions, denser at the rim. No two lie on a circle or a
/// ray: rows of a grid would cross the edges of the integrand all at once, which traps a search.
std::vector<Place> halfDisc(int count) {
    std::vector<Place> places;
    for (int i = 0; i < count; ++i) {
        const double left = 1.0 - (i + 0.5) / count, radius = std::sqrt(1.0 - std::pow(left, kGrading));
        const double turn = (i + 0.5) * std::numbers::phi, angle = pi * (turn - std::floor(turn));
        places.push_back(
            {radius * glm::dvec2(std::cos(angle), std::sin(angle)), kGrading * std::pow(left, kGrading - 1.0) / count});
    }
    return places;
}

/// The direction of reflection at the visible microfacet that a point on the disc samples. Source: Heitz 2018,
/// "Sampling the GGX Distribution of Visible Normals".
glm::dvec3 lightOfVisible(const View& view, const glm::dvec2& disc) {
    const glm::dvec3 stretched = glm::dvec3(view.alpha * view.sine, 0.0, view.cosine) / view.width;
    const glm::dvec3 upwards(-stretched.z, 0.0, stretched.x);
    const double chord = std::sqrt(1.0 - disc.y * disc.y), share = 0.5 * (1.0 + stretched.z);
    const double up = (1.0 - share) * chord + share * disc.x;
    const double towards = std::sqrt(std::max(0.0, chord * chord - up * up));
    const glm::dvec3 facet = disc.y * glm::dvec3(0.0, 1.0, 0.0) + up * upwards + towards * stretched;
    const glm::dvec3 half =
        glm::normalize(glm::dvec3(view.alpha * facet.x, view.alpha * facet.y, std::max(facet.z, 1e-9)));
    const glm::dvec3 viewer(view.sine, 0.0, view.cosine);
    return 2.0 * glm::dot(viewer, half) * half - viewer;
}

/// A linearly transformed cosine, from four numbers of the table.
class Shape {
public:
    Shape(const glm::vec4& numbers, const View& view)
        : inverse_(tessera::shared::inverseOfShape(numbers, float(view.alpha), float(view.cosine), float(view.sine))) {
        determinant_ = glm::determinant(inverse_);
        share_ = double(tessera::shared::shareAbove(glm::mat3(inverse_)));
    }
    bool isValid() const { return determinant_ > 0.0 && share_ > 0.0; }
    double shareAbove() const { return share_; }
    const glm::dmat3& inverse() const { return inverse_; }
    /// Integrates to 1 over the sphere.
    double density(const glm::dvec3& light) const {
        const glm::dvec3 cosine = inverse_ * light;
        const double length2 = glm::dot(cosine, cosine);
        return determinant_ * std::max(cosine.z, 0.0) / (pi * length2 * length2);
    }

private:
    glm::dmat3 inverse_;
    double determinant_ = 0.0, share_ = 0.0;
};

/// The distance of shapes from the lobe of a view.
class Lobe {
public:
    explicit Lobe(const View& view) : view_(view) {
        for (const Place& place : halfDisc(kSamples)) {
            const glm::dvec3 light = lightOfVisible(view, place.disc);
            const Densities densities = densitiesAt(view, light);
            if (light.z <= 0.0 || !(densities.visible > 0.0)) continue;
            samples_.push_back({light, place.share, densities});
            total_ += place.share * densities.brdfCosine / densities.visible;
        }
    }

    /// The integral of |lobe - shape| over the hemisphere, both scaled to integrate to 1: twice the largest error of a
    /// uniformly bright light of any outline, relative to the lobe's reflection of uniform illumination. (The paper
    /// uses the third power, and does not scale shapes that lie partly below the surface.) Samples both, weighted by
    /// the balance heuristic: Veach and Guibas 1995, "Optimally Combining Sampling Techniques for Monte Carlo
    /// Rendering".
    double distance(const glm::vec4& numbers) const {
        const Shape shape(numbers, view_);
        if (!shape.isValid()) return 1e3;
        double sum = 0.0;
        const auto add = [&](const glm::dvec3& light, double share, const Densities& densities) {
            const double density = shape.density(light);
            sum += share * std::abs(densities.brdfCosine / total_ - density / shape.shareAbove()) /
                   (densities.visible + density);
        };
        for (const Sample& sample : samples_) add(sample.light, sample.share, sample.densities);
        const glm::dmat3 forwards = glm::inverse(shape.inverse());
        static const std::vector<Place> places = halfDisc(kShapeSamples);
        for (const auto& [disc, share] : places) {
            const double up = std::sqrt(1.0 - glm::dot(disc, disc));
            const glm::dvec3 light = glm::normalize(forwards * glm::dvec3(disc, up));
            if (light.z > 0.0) add(light, share, densitiesAt(view_, light));
        }
        return sum;
    }

private:
    struct Sample {
        glm::dvec3 light;
        double share = 0.0;
        Densities densities;
    };
    View view_;
    std::vector<Sample> samples_;
    double total_ = 0.0; ///< the lobe's reflection of uniform illumination
};

struct Fitted {
    glm::vec4 numbers{0.0f};
    double cost = std::numeric_limits<double>::infinity();
};

/// Minimises the distance from a start. Adds `pull` times the squared difference to `target`: numbers that hardly
/// matter stay near their neighbours'. With the view along the normal the lobe is isotropic, and only s is free.
Fitted minimise(const Lobe& lobe, const glm::vec4& start, const glm::vec4& target, double pull, bool isAlongNormal) {
    struct Search {
        const Lobe& lobe;
        glm::vec4 start, target;
        double pull;
        bool isAlongNormal;
        glm::vec4 numbersOf(const std::vector<double>& x) const {
            if (isAlongNormal) return {1.0f, start.y, float(x[0]), start.w};
            return {float(x[0]), float(x[1]), float(x[2]), float(x[3])};
        }
        static double cost(const std::vector<double>& x, std::vector<double>&, void* search) {
            const Search& self = *static_cast<const Search*>(search);
            const glm::vec4 numbers = self.numbersOf(x), off = numbers - self.target;
            return self.lobe.distance(numbers) + self.pull * double(glm::dot(off, off));
        }
    } search{lobe, start, target, pull, isAlongNormal};
    std::vector<double> x = {double(start.z)};
    if (!isAlongNormal) x = {double(start.x), double(start.y), double(start.z), double(start.w)};
    nlopt::opt simplex(nlopt::LN_NELDERMEAD, unsigned(x.size()));
    simplex.set_min_objective(&Search::cost, &search);
    simplex.set_xtol_abs(2e-6);
    simplex.set_maxeval(2000);
    double best = std::numeric_limits<double>::infinity();
    for (double step = 0.1, least = 0.0;; step *= 0.5, best = least) { // a simplex may collapse: restart
        simplex.set_initial_step(step);
        simplex.optimize(x, least);
        if (!(least < best - 1e-6)) break;
    }
    return {search.numbersOf(x), best};
}

double alphaOf(int row) {
    const double up = double(row) / (kSide - 1);
    return std::max(up * up, double(LOBE_SHAPES_SMALLEST_ALPHA));
}
double cosineOf(int column) {
    const double right = double(column) / (kSide - 1);
    return std::max(right * right, double(LOBE_SHAPES_SMALLEST_COSINE));
}

class Table {
public:
    /// Fits from the rough end and from the normal outwards: each entry starts from its fitted neighbours.
    void fit() {
        for (int row = kSide - 1; row >= 0; --row) {
            const glm::vec4 rougher = row + 1 < kSide ? at(row + 1, kSide - 1) : glm::vec4(1.0f, 0.0f, 2.0f, 0.0f);
            // q and r have no effect at the normal, but are interpolated to the next column.
            const glm::vec4 near = best(Lobe(View(alphaOf(row), kNearNormal)), {rougher}, kSlightPull);
            at(row, kSide - 1) = alongNormal(row, near);
            for (int column = kSide - 2; column >= 0; --column) {
                std::vector<glm::vec4> starts = {at(row, column + 1)};
                if (row + 1 < kSide) starts.push_back(at(row + 1, column));
                at(row, column) = best(Lobe(View(alphaOf(row), cosineOf(column))), starts, kSlightPull);
            }
            std::fprintf(stderr, "fitted alpha %.5f\n", alphaOf(row));
        }
    }
    /// Fits each entry again, pulled to the mean of its neighbours.
    void smooth() {
        for (int row = 0; row < kSide; ++row)
            for (int column = 0; column < kSide - 1; ++column) {
                glm::vec4 sum(0.0f);
                float count = 0.0f;
                const auto add = [&](const glm::vec4& one, const glm::vec4& other) {
                    sum += one + other;
                    count += 2.0f;
                };
                if (row > 0 && row + 1 < kSide) add(at(row - 1, column), at(row + 1, column));
                if (column > 0) add(at(row, column - 1), at(row, column + 1));
                if (count == 0.0f) continue;
                const Lobe lobe(View(alphaOf(row), cosineOf(column)));
                at(row, column) = minimise(lobe, sum / count, sum / count, kPull, false).numbers;
            }
    }
    const std::vector<glm::vec4>& entries() const { return entries_; }

private:
    static constexpr double kNearNormal = 0.995, kSlightPull = 1e-5, kPull = 1e-2;
    std::vector<glm::vec4> entries_ = std::vector<glm::vec4>(std::size_t(kSide) * kSide);

    glm::vec4& at(int row, int column) { return entries_[std::size_t(row * kSide + column)]; }
    static glm::vec4 best(const Lobe& lobe, const std::vector<glm::vec4>& starts, double pull) {
        Fitted least;
        for (const glm::vec4& start : starts) {
            const Fitted found = minimise(lobe, start, start, pull, false);
            if (found.cost < least.cost) least = found;
        }
        return least.numbers;
    }
    static glm::vec4 alongNormal(int row, const glm::vec4& near) {
        return minimise(Lobe(View(alphaOf(row), 1.0)), near, near, 0.0, true).numbers;
    }
};

void write(const std::string& path, const std::vector<glm::vec4>& table) {
    const std::string part = path + ".part";
    std::FILE* const file = std::fopen(part.c_str(), "w");
    if (!file) throw std::runtime_error(part + ": cannot be written");
    std::fprintf(file, "// Made by tools/lobe_shapes: cmake --build --preset release --target lobe_shapes\n");
    for (const glm::vec4& n : table)
        std::fprintf(file, "{%.5f, %.5f, %.5f, %.5f},\n", double(n.x), double(n.y), double(n.z), double(n.w));
    if (std::fclose(file) != 0 || std::rename(part.c_str(), path.c_str()) != 0)
        throw std::runtime_error(path + ": cannot be written");
}

} // namespace

int main(int argc, char** argv) try {
    if (argc != 2) throw std::runtime_error("usage: tessera_lobe_shapes FILE");
    Table table;
    table.fit();
    for (int i = 0; i < 3; ++i) table.smooth();
    write(argv[1], table.entries());
} catch (const std::exception& error) {
    std::fprintf(stderr, "tessera_lobe_shapes: %s\n", error.what());
    return 1;
}
