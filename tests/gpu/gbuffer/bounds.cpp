// Compares the error of every stored value with the bound derived from its field (tests/support/GBufferBounds.h).
#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/gpu/gbuffer/Surfaces.h"
#include "tests/support/GBufferBounds.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using frame::Channel;
using test::GBufferTest;
using test::StoredSurface;

/// The error of a stored value; NaN if the surface has no such value.
using Error = std::function<double(const StoredSurface& was, const StoredSurface& is)>;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double angleDegrees(const glm::dvec3& x, const glm::dvec3& y) {
    return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180.0 / test::pi;
}
double rootError(float was, float is, double power) {
    return std::abs(std::pow(double(was), power) - std::pow(double(is), power));
}
bool isBlinnPhong(const StoredSurface& s) {
    return s.model == float(scenes::MaterialModel::BlinnPhong);
}
bool isMicrofacet(const StoredSurface& s) {
    return s.model == float(scenes::MaterialModel::Microfacet) ||
           s.model == float(scenes::MaterialModel::MicrofacetAnisotropic);
}
double contrast(double ior) {
    return (ior - 1.0) / (ior + 1.0);
}

using Key = std::pair<Channel, std::string_view>;

std::map<Key, Error> errors(frame::Encoding encoding) {
    std::map<Key, Error> all;
    constexpr std::string_view kRoots[] = {"square root of red", "square root of green", "square root of blue"};
    constexpr std::string_view kColours[] = {"red", "green", "blue"};
    const frame::RadianceRange range = frame::radianceRange(encoding);
    for (int c = 0; c < 3; ++c) {
        const std::string_view root = kRoots[c], colour = kColours[c];
        all[{Channel::Albedo, root}] = [c](auto& a, auto& b) { return rootError(a.albedo[c], b.albedo[c], 0.5); };
        all[{Channel::Specular, root}] = [c](auto& a, auto& b) { return rootError(a.specular[c], b.specular[c], 0.5); };
        all[{Channel::Sheen, root}] = [c](auto& a, auto& b) {
            return rootError(a.sheenColor[c], b.sheenColor[c], 0.5);
        };
        all[{Channel::Emission, colour}] = [c, range](auto& a, auto& b) {
            const glm::dvec3 held = glm::min(glm::dvec3(a.emission), glm::dvec3(range.most));
            const double largest = std::max({held.x, held.y, held.z, range.least});
            return std::abs(held[c] - double(b.emission[c])) / largest;
        };
        all[{Channel::NormalTexel, colour}] = [c](auto& a, auto& b) {
            return std::abs(double(a.normalTexel[c]) - double(b.normalTexel[c]));
        };
    }
    all[{Channel::Normal, "direction"}] = [](auto& a, auto& b) { return angleDegrees(a.normal, b.normal); };
    all[{Channel::Microsurface, "fourth root of alpha"}] = [](auto& a, auto& b) {
        return isBlinnPhong(a) ? kNone : rootError(a.alpha, b.alpha, 0.25);
    };
    all[{Channel::Microsurface, "(ior-1)/(ior+1)"}] = [](auto& a, auto& b) {
        return isMicrofacet(a) ? std::abs(contrast(a.iorOrF90) - contrast(b.iorOrF90)) : kNone;
    };
    all[{Channel::Microsurface, "F90"}] = [](auto& a, auto& b) {
        return isMicrofacet(a) || isBlinnPhong(a) ? kNone : std::abs(double(a.iorOrF90) - double(b.iorOrF90));
    };
    all[{Channel::Microsurface, "metallic"}] = [](auto& a, auto& b) {
        return isMicrofacet(a) || isBlinnPhong(a) ? kNone : std::abs(double(a.metallic) - double(b.metallic));
    };
    all[{Channel::Microsurface, "exponent"}] = [](auto& a, auto& b) {
        return isBlinnPhong(a) && a.exponent > 0.0f ? std::abs(b.exponent / double(a.exponent) - 1.0) : kNone;
    };
    all[{Channel::Tangent, "direction"}] = [](auto& a, auto& b) {
        const double angle = angleDegrees(a.tangent, b.tangent);
        return std::min(angle, 180.0 - angle); // the sign of a tangent is irrelevant
    };
    all[{Channel::Tangent, "fourth root of alpha"}] = [](auto& a, auto& b) {
        return rootError(a.alphaBitangent, b.alphaBitangent, 0.25);
    };
    all[{Channel::Clearcoat, "direction"}] = [](auto& a, auto& b) {
        return angleDegrees(test::fromOctahedral(a.coatNormal.x, a.coatNormal.y),
                            test::fromOctahedral(b.coatNormal.x, b.coatNormal.y));
    };
    all[{Channel::Clearcoat, "share"}] = [](auto& a, auto& b) {
        return std::abs(double(a.coatFactor) - double(b.coatFactor));
    };
    all[{Channel::Clearcoat, "fourth root of alpha"}] = [](auto& a, auto& b) {
        return rootError(a.coatAlpha, b.coatAlpha, 0.25);
    };
    all[{Channel::Sheen, "fourth root of alpha"}] = [](auto& a, auto& b) {
        return rootError(a.sheenAlpha, b.sheenAlpha, 0.25);
    };
    return all;
}

TEST_F(GBufferTest, errorsNeverExceedTheBoundDerivedFromTheirFieldAndComeNearIt) {
    for (const frame::Encoding encoding : {frame::Encoding::Packed, frame::Encoding::Slim}) {
        std::vector<StoredSurface> surfaces = test::randomSurfaces(200000);
        for (const std::vector<StoredSurface>& more :
             {test::surfacesBetweenSteps(encoding, 200000), test::surfacesAtTheEnds()})
            surfaces.insert(surfaces.end(), more.begin(), more.end());
        const std::vector<StoredSurface> back = roundTrip(surfaces, encoding);
        const std::map<Key, Error> errorOf = errors(encoding);
        for (const frame::FieldBound& bound : frame::fieldBounds(encoding)) {
            const std::string name =
                fmt::format("{} {}: {}", frame::layoutTable()[std::size_t(encoding)].name,
                            frame::channelTable()[std::size_t(bound.channel)].name, bound.quantity);
            const Error& error = errorOf.at({bound.channel, bound.quantity});
            double worst = 0.0;
            std::size_t where = 0;
            for (std::size_t i = 0; i < surfaces.size(); ++i) {
                const double e = error(surfaces[i], back[i]);
                if (e > worst) {
                    worst = e;
                    where = i;
                }
            }
            fmt::print("{}: {:.3g} of {:.3g} {}\n", name, worst, bound.bound, bound.unit);
            // 2e-6 for some ten fp32 roundings of values around 1 on the way to a code and back. Angles are in degrees,
            // and the octahedral mapping's second order adds a fraction of the bound.
            const bool angle = bound.unit == "degrees";
            const double rounding = angle ? 2e-5 + bound.bound * 2e-3 : 2e-6;
            EXPECT_LE(worst, bound.bound + rounding) << name << ", surface " << where;
            EXPECT_GE(worst, bound.bound / 4.0) << name << ": the bound says nothing";
        }
    }
}

/// The quantities in which lighting is linear, or nearly: a uniform surface shows their mean over pixels. Tangents and
/// the coat's normal are not dithered.
std::vector<double> linearValues(const StoredSurface& s) {
    std::vector<double> values;
    const auto add = [&](const glm::vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); };
    for (const glm::vec3& v : {s.albedo, s.normal, s.specular, s.emission, s.sheenColor, s.normalTexel}) add(v);
    const double reflectance = isMicrofacet(s) ? contrast(s.iorOrF90) * contrast(s.iorOrF90) : s.iorOrF90;
    const double metallic = isMicrofacet(s) || isBlinnPhong(s) ? 0.0 : s.metallic;
    values.insert(values.end(), {s.alpha, s.exponent, reflectance, metallic, s.alphaBitangent, s.coatFactor,
                                 s.coatAlpha, s.sheenAlpha});
    return values;
}

/// Whether one code rounds both: components of the normal, or the alphas of a lobe and blinn_phong's exponent.
bool areRoundedTogether(std::size_t a, std::size_t b) {
    const auto groupOf = [](std::size_t value) {
        if (value >= 3 && value < 6) return 1;
        return value == 18 || value == 19 || value == 22 ? 2 : 0;
    };
    return groupOf(a) != 0 && groupOf(a) == groupOf(b);
}

/// The largest correlation of the errors of two values that are not rounded together; row r of `errors` is pixel r's.
double worstCorrelation(const std::vector<std::vector<double>>& errors) {
    const std::size_t count = errors.front().size();
    std::vector<double> squares(count, 0.0), products(count * count, 0.0);
    for (const std::vector<double>& e : errors) {
        for (std::size_t a = 0; a < count; ++a) {
            squares[a] += e[a] * e[a];
            for (std::size_t b = 0; b < a; ++b) products[a * count + b] += e[a] * e[b];
        }
    }
    double worst = 0.0;
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            if (squares[a] > 0.0 && squares[b] > 0.0 && !areRoundedTogether(a, b))
                worst = std::max(worst, std::abs(products[a * count + b]) / std::sqrt(squares[a] * squares[b]));
        }
    }
    return worst;
}

/// The largest relative error of the mean of one of a surface's alphas.
double worstMeanOfAlphas(const StoredSurface& surface, const std::vector<StoredSurface>& back) {
    double worst = 0.0;
    for (float StoredSurface::*const alpha : {&StoredSurface::alpha, &StoredSurface::alphaBitangent,
                                              &StoredSurface::coatAlpha, &StoredSurface::sheenAlpha}) {
        double mean = 0.0;
        for (const StoredSurface& stored : back) mean += double(stored.*alpha) / double(back.size());
        worst = std::max(worst, std::abs(mean / double(surface.*alpha) - 1.0));
    }
    return worst;
}

TEST_F(GBufferTest, theMeanOfASmallAlphaOverPixelsIsThatAlpha) {
    for (const frame::Encoding encoding : {frame::Encoding::Packed, frame::Encoding::Slim}) {
        const std::vector<StoredSurface> random = test::randomSurfaces(6);
        const auto found = std::ranges::find_if(random, [](const StoredSurface& s) { return isMicrofacet(s); });
        ASSERT_NE(found, random.end());
        for (const float alpha : {0.0123f, 0.0307f, 0.0551f, 0.0823f, 0.0999f}) {
            StoredSurface surface = *found;
            surface.alpha = surface.alphaBitangent = surface.coatAlpha = surface.sheenAlpha = alpha;
            const double worst =
                worstMeanOfAlphas(surface, roundTrip(std::vector<StoredSurface>(512 * 128, surface), encoding));
            fmt::print("{}, alpha {}: {:.1e}\n", frame::layoutTable()[std::size_t(encoding)].name, alpha, worst);
            EXPECT_LE(worst, 1e-4) << alpha;
        }
    }
}

TEST_F(GBufferTest, theMeanOfAValueOverPixelsIsTheValue) {
    for (const frame::Encoding encoding : {frame::Encoding::Packed, frame::Encoding::Slim}) {
        double worst = 0.0, correlation = 0.0;
        std::vector<StoredSurface> random = test::randomSurfaces(6);
        random.resize(6); // one of each model, without the axes appended to them
        for (StoredSurface surface : random) {
            if (surface.emission.x > 1e3f || surface.emission.x < 1e-3f) surface.emission = surface.albedo;
            if (isBlinnPhong(surface)) surface.alpha = 1.0f;                                // not stored
            if (isMicrofacet(surface)) surface.iorOrF90 = std::min(surface.iorOrF90, 5.0f); // clamped far above
            // A whole image of the same surface.
            const std::vector<StoredSurface> back = roundTrip(std::vector<StoredSurface>(512 * 128, surface), encoding);
            const std::vector<double> wanted = linearValues(surface);
            std::vector<double> mean(wanted.size(), 0.0);
            std::vector<std::vector<double>> errors;
            for (const StoredSurface& stored : back) {
                std::vector<double> values = linearValues(stored);
                for (std::size_t v = 0; v < values.size(); ++v) {
                    mean[v] += values[v] / double(back.size());
                    values[v] -= wanted[v];
                }
                errors.push_back(std::move(values));
            }
            correlation = std::max(correlation, worstCorrelation(errors));
            for (std::size_t v = 0; v < wanted.size(); ++v) {
                const double bias = std::abs(mean[v] - wanted[v]) / std::max(1.0, std::abs(wanted[v]));
                worst = std::max(worst, bias);
                // Components of a unit vector are linear in its code except for the second order of a step. F90 has one
                // bit in `slim`: the thresholds of all pixels are uniform to 1.3e-4 of that step.
                const bool isOneBit = v == 20 && encoding == frame::Encoding::Slim && !isMicrofacet(surface);
                EXPECT_LE(bias, isOneBit ? 2e-4 : 1e-4)
                    << "value " << v << " is " << wanted[v] << ", in the mean " << mean[v];
            }
        }
        fmt::print("{}: means are off by {:.2g} at most, errors correlate by {:.2g} at most\n",
                   frame::layoutTable()[std::size_t(encoding)].name, worst, correlation);
        // If one threshold rounded two values near the middle of a step, their errors would correlate by 1. Independent
        // errors correlate by chance, more if they are rare: at 1/1000 of a step, 65 pixels have an error.
        EXPECT_LE(correlation, 0.15);
    }
}

} // namespace
} // namespace tessera
