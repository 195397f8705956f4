#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

/// GGX alpha is never smaller, by the product's definition of its models.
inline constexpr double kSmallestAlpha = 1e-3;

/// The material at a point: factors times texels. Parameters that a model does not have keep their neutral value.
struct SurfacePoint {
    scenes::MaterialModel model = scenes::MaterialModel::Lambert;
    glm::dvec3 color{0.0};                             ///< base colour, k_d, or the unlit colour
    double opacity = 1.0;                              ///< 0..1, coverage of the background
    double metallic = 0.0;                             ///< 0..1
    double alpha = 1.0;                                ///< of GGX; along the tangent where the lobe is anisotropic
    double alphaAcross = 1.0;                          ///< along the bitangent
    bool reflectsLobe = true;                          ///< false leaves the lobe out, as withoutMirrors() does
    scenes::Masking masking = scenes::Masking::Walter; ///< of the microfacet models
    double roughness = 0.0;        ///< as the model has it: perceptual, alpha, exponent of blinn_phong
    double ior = 1.5;              ///< n2/n1
    double specularFactor = 1.0;   ///< KHR_materials_specular
    glm::dvec3 specularColor{1.0}; ///< k_s, or the tint of the dielectric reflectance
    double openness = 1.0;         ///< 0..1, the fraction of the environment's light that arrives
    glm::dvec3 emission{0.0};      ///< emitted radiance, without the unlit colour
    glm::dvec3 normal{0.0};        ///< unit, world axes: the shading normal
    glm::dvec3 tangent{0.0};       ///< unit, perpendicular to it, where the lobe is anisotropic
    double coat = 0.0;             ///< 0..1, KHR_materials_clearcoat
    double coatAlpha = 1.0;
    bool reflectsCoatLobe = true; ///< likewise; the layers below stay attenuated
    glm::dvec3 coatNormal{0.0};   ///< unit, where there is a coat
    glm::dvec3 sheenColor{0.0};   ///< 0..1, KHR_materials_sheen
    double sheenAlpha = 1.0;
    double film = 0.0;                ///< 0..1, KHR_materials_iridescence
    double filmIor = 1.3;             ///< at least 1
    double filmThicknessNm = 0.0;     ///< nanometres
    double transmission = 0.0;        ///< 0..1, KHR_materials_transmission
    bool hasBody = false;             ///< bends and absorbs transmitted light, KHR_materials_volume
    glm::dvec3 bodyPerMetre{0.0};     ///< absorption of transmitted light, by channel, per scene metre
    double dispersion = 0.0;          ///< 20 over the Abbe number, KHR_materials_dispersion
    double passingAlpha = 1.0;        ///< GGX alpha of transmission; the least: it is not scattered
    double bodyMetres = 0.0;          ///< thickness of the body
    glm::dvec3 wrap{0.0};             ///< by channel, minus the cosine at which wrapped light ends
    double bodyRadiusMetres = 0.0;    ///< of the body that wrapped light travels round
    bool diffuses = false;            ///< diffuses light that enters (Diffusion.h)
    bool passes = false;              ///< transmits light from behind
    glm::dvec3 absorptionPerMetre{0}; ///< of light from behind, by channel, per scene metre
    /// The values that transmission keeps where a hook has changed those of the surface.
    std::optional<glm::dvec3> passingColor;
    std::optional<double> passingMetallic;
};

/// `change` gets the point before its tangent, layers and transmission are known, and may change its parameters.
SurfacePoint surfaceAt(const Hit& hit, const Textures& textures,
                       const std::function<void(SurfacePoint& point)>& change = {});

/// Base colour's alpha x texel x vertex colour, unclamped.
double opacityAt(const Hit& hit, const Textures& textures);

} // namespace tessera::reference
