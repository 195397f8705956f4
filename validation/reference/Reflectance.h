#pragma once
#include <optional>
#include <span>
#include <vector>

#include "validation/reference/MaterialAt.h"

namespace tessera::reference {

/// Directions from a surface point to a light and to the viewer; all unit.
struct Directions {
    Directions(const glm::dvec3& normal, const glm::dvec3& toLight, const glm::dvec3& toViewer);
    glm::dvec3 normal, toLight, toViewer;
    glm::dvec3 half{0.0}; ///< halfway between light and viewer; zero where they are opposite
    double cosLight = 0.0, cosView = 0.0, cosHalf = 0.0; ///< with the normal
    double cosIncidence = 0.0;                           ///< between light and half vector
    /// Whether a specular lobe exists: light and viewer above the horizon, and not opposite to each other.
    bool hasLobe() const { return cosLight > 0.0 && cosView > 0.0 && half != glm::dvec3(0.0); }
};

/// How a material model reflects light. The table is the only list of models.
struct Model {
    scenes::MaterialModel model;
    /// BRDF times max(0, n.l) for a light above the horizon; `specular` false leaves the specular lobe out.
    glm::dvec3 (*reflected)(const SurfacePoint& point, const Directions& directions, bool specular);
    /// BRDF of the light that enters the surface, for a light in any direction.
    glm::dvec3 (*entering)(const SurfacePoint& point, const Directions& directions);
    /// Reflectance of the lobe as a mirror; null: it never is one.
    glm::dvec3 (*mirrored)(const SurfacePoint& point, double cosView) = nullptr;
};
std::span<const Model> modelTable();

/// The table's row. Throws std::logic_error when there is none.
const Model& modelOf(scenes::MaterialModel model);

/// Fresnel reflectance of metallic_roughness: Schlick's curve from `straight` at normal incidence to `grazing`, with
/// the reflectances of KHR_materials_ior and KHR_materials_specular. A film (KHR_materials_iridescence) changes the
/// curve so that it passes through the film's reflectance at the viewer's cosine.
struct ReflectanceRange {
    glm::dvec3 straight{0.0};
    double grazing = 1.0;
};
ReflectanceRange reflectanceRange(const SurfacePoint& point, double cosView);

/// BRDF times cosine: radiance towards the viewer per irradiance at normal incidence; 0 for light from below the
/// horizon of each layer.
glm::dvec3 reflected(const SurfacePoint& point, const glm::dvec3& toLight, const glm::dvec3& toViewer, bool specular);

/// Under environment light, lobes of the least alpha are mirrors, by the product's definition.
struct Mirror {
    glm::dvec3 direction; ///< unit, of the reflected ray
    glm::dvec3 share;     ///< reflectance for the radiance from there
};
std::vector<Mirror> mirrorsOf(const SurfacePoint& point, const glm::dvec3& toViewer);
/// The surface without its mirrors.
SurfacePoint withoutMirrors(const SurfacePoint& point);

/// As reflected(), for light from below the horizon that passes through the surface and keeps its angle to the normal.
glm::dvec3 passedOn(const SurfacePoint& point, const glm::dvec3& toLight, const glm::dvec3& toViewer);

/// The part of the light behind a surface that the surface does not reflect, by channel.
glm::dvec3 transmittanceOf(const SurfacePoint& point, const glm::dvec3& toViewer);
/// Factor of the radiance behind a surface if it reflected nothing, before absorption by its body.
glm::dvec3 passingIfNoneReflected(const SurfacePoint& point, const glm::dvec3& toViewer);
/// Factor of the radiance behind a surface, before absorption by its body.
inline glm::dvec3 transmitted(const SurfacePoint& point, const glm::dvec3& toViewer) {
    return passingIfNoneReflected(point, toViewer) * transmittanceOf(point, toViewer);
}

/// Transmittance of a body over these path lengths in metres, by channel (Beer's law).
glm::dvec3 leftByBody(const SurfacePoint& point, const glm::dvec3& wayMetres);

/// The viewer's ray refracted into a body, unit; empty beyond the critical angle. By Snell's law for an index of
/// refraction, where 0 stands for infinity.
std::optional<glm::dvec3> refracted(const SurfacePoint& point, const glm::dvec3& toViewer, double ior);

/// The body's index of refraction for red, green and blue. Source: KHR_materials_dispersion.
glm::dvec3 iorsOf(const SurfacePoint& point);

/// Factor of diffused irradiance below the surface that leaves towards the viewer.
glm::dvec3 leaving(const SurfacePoint& point, const glm::dvec3& toViewer, double preScatterShare);

/// Emitted radiance towards the viewer, attenuated by the coat.
glm::dvec3 emitted(const SurfacePoint& point, const glm::dvec3& toViewer);

} // namespace tessera::reference
