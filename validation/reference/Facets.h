#pragma once
#include <optional>

#include "validation/reference/Sampling.h"

namespace tessera::reference {

/// The microfacets of a rough interface, which refract the viewer's ray, or reflect it beyond the critical angle. The
/// lobe is the published one, times the Fresnel transmittance or reflectance.
/// Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", equations 16, 17, 20, 21, 23,
/// 33 to 36 and 38. An index of 0 stands for infinity, in transmission.
class Facets : public Strategy {
public:
    enum class Send { Through, Back };
    /// `normal` on the ray's side, `toViewer` back along the ray, `ior` of the far side over the ray's side.
    Facets(const glm::dvec3& normal, double alpha, const glm::dvec3& toViewer, double ior, Send send)
        : frame_(frameOf(normal)), alpha_(alpha), toViewer_(toViewer), ior_(ior), send_(send) {}

    glm::dvec3 direction(const glm::dvec2& random) const override; ///< 0 if the facet sends nothing there
    double density(const glm::dvec3& direction) const override;
    /// BSDF times cosine for light from a direction, 1/sr, up to a constant factor.
    double share(const glm::dvec3& direction) const;
    double whole() const; ///< the integral of share()

private:
    struct Met {
        glm::dvec3 half{0.0};   ///< unit, on the side of the ray
        double perHalf = 0.0;   ///< Jacobian, sr of half vectors per sr of directions; 0: no facet sends the ray there
        double cosNormal = 0.0; ///< of the direction with the normal on its side
    };
    Met met(const glm::dvec3& direction) const;

    Frame frame_;
    double alpha_;
    glm::dvec3 toViewer_;
    double ior_;
    Send send_;
};

/// A path of transmitted light up to the last interface of a body or a sheet.
struct Scatter {
    glm::dvec3 originRWS{0.0};
    glm::dvec3 direction{0.0};    ///< if no facets scatter it
    std::optional<Facets> facets; ///< the facets that scatter it
    double weight = 1.0;
};

} // namespace tessera::reference
