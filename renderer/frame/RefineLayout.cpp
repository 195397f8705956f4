#include "renderer/frame/RefineLayout.h"

#include <algorithm>

#include "renderer/frame/Features.h"
#include "renderer/frame/MaterialFeatures.h"
#include "scenes/InUse.h"

namespace tessera::frame {

namespace {

using scenes::Material;
using scenes::TextureSlot;

constexpr std::string_view kBright = "a colour of the scene may exceed 1, which its packed field cannot hold";
constexpr std::string_view kGrazing = "a material masks by the half vector, which magnifies what n.v is off at grazing "
                                      "angles";

constexpr std::string_view kDiffusion = "light diffused over a surface is stored as emission, and spans more "
                                        "powers of ten than half floats";

constexpr std::string_view kFilm =
    "a thin film may reflect hardly anything, of which the packed field has too few steps";
constexpr std::string_view kStreak =
    "an anisotropic highlight is a streak over much of a surface, and a coarse step of "
    "its alphas shows in all of it";
constexpr std::string_view kThin = "an anisotropic highlight may be as thin as the normal's coarse step is wide";
/// Below this alpha, the RMS error of slim's normal, 5.7e-4 rad, changes a streak by more than 1e-4 in relMse: its
/// radiance falls off by up to 1.5/alpha per radian.
constexpr float kThinAlpha = 0.1f;

constexpr std::string_view kHooked = "a hook may emit more than its packed field can hold";

bool exceedsOne(const scenes::Scene& scene, const glm::vec3& factor, const scenes::TextureUse& texture) {
    const bool isFloat = texture.image != scenes::kNone &&
                         scene.images[std::size_t(texture.image)].format == scenes::TexelFormat::Rgba32Float;
    return isFloat || std::max({factor.r, factor.g, factor.b}) > 1.0f;
}

bool hasBrightColors(const scenes::Mesh& mesh) {
    return std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const glm::vec4& color) {
        return std::max({color.r, color.g, color.b}) > 1.0f;
    });
}

/// Whether any material in use satisfies the predicate.
template <typename Predicate>
bool anyMaterial(const scenes::Scene& scene, Predicate&& isSo) {
    const std::vector<const Material*> used = scenes::materialsInUse(scene);
    return std::any_of(used.begin(), used.end(), [&](const Material* material) { return isSo(*material); });
}

bool hasBrightAlbedo(const scenes::Scene& scene) {
    const auto isBright = [&](const Material& material) {
        // The colour of an unlit surface is radiance, and goes to another channel.
        return scenes::infoOf(material.model).isLit &&
               exceedsOne(scene, glm::vec3(material.baseColor), material.texture(TextureSlot::BaseColor));
    };
    const std::vector<const scenes::Mesh*> meshes = scenes::meshesInUse(scene);
    return anyMaterial(scene, isBright) ||
           std::any_of(meshes.begin(), meshes.end(), [](const scenes::Mesh* mesh) { return hasBrightColors(*mesh); });
}

bool hasBrightSpecular(const scenes::Scene& scene) {
    return anyMaterial(scene, [&](const Material& material) {
        // The F0 of metallic_roughness is clamped to 1 before it is stored.
        return scenes::infoOf(material.model).highlight == scenes::Highlight::Tinted &&
               exceedsOne(scene, material.specularColor, material.texture(TextureSlot::SpecularColor));
    });
}

/// Whether a thin film is stored in the G-buffer; transparent surfaces are not.
bool storesFilms(const scenes::Scene& scene) {
    return anyMaterial(scene, [](const Material& material) {
        return scenes::isIridescent(material) && !scenes::isTransparent(material);
    });
}

/// Whether the material is stored in the G-buffer with an anisotropic highlight.
bool storesStreak(const Material& material) {
    return scenes::isAnisotropic(material) && !scenes::isTransparent(material);
}

/// Whether the smaller of a streak's alphas may be below kThinAlpha. Textures may scale them down to 0.
bool mayBeThin(const Material& material) {
    if (!storesStreak(material)) return false;
    const auto isTextured = [&](TextureSlot slot) { return material.texture(slot).image != scenes::kNone; };
    const bool hasAlphas = scenes::infoOf(material.model).anisotropy == scenes::Anisotropy::Alphas;
    const float least = hasAlphas ? std::min(material.alpha, material.alphaY)
                                  : material.perceptualRoughness * material.perceptualRoughness;
    return least < kThinAlpha || isTextured(TextureSlot::MetallicRoughness) ||
           (hasAlphas && isTextured(TextureSlot::Anisotropy));
}

bool masksByHalfVector(const scenes::Scene& scene) {
    return anyMaterial(scene, [](const Material& material) {
        return canMask(material) && material.masking == scenes::Masking::HalfVector;
    });
}

} // namespace

std::vector<Refinement> refinements(const GBufferLayout& layout, const scenes::Scene& scene,
                                    scenes::SubsurfaceRequest subsurface) {
    std::vector<Refinement> found;
    if (layout[Channel::Albedo] != Encoding::Exact && hasBrightAlbedo(scene))
        found.push_back({Channel::Albedo, Encoding::Exact, kBright});
    if (layout[Channel::Normal] == Encoding::Slim && masksByHalfVector(scene))
        found.push_back({Channel::Normal, Encoding::Packed, kGrazing});
    else if (layout[Channel::Normal] == Encoding::Slim && anyMaterial(scene, mayBeThin))
        found.push_back({Channel::Normal, Encoding::Packed, kThin});
    // Refines both alphas: different steps would make isotropic surfaces of the scene anisotropic.
    if (anyMaterial(scene, storesStreak))
        for (const Channel channel : {Channel::Microsurface, Channel::Tangent})
            if (layout[channel] == Encoding::Slim) found.push_back({channel, Encoding::Packed, kStreak});
    if (layout[Channel::Specular] != Encoding::Exact && hasBrightSpecular(scene))
        found.push_back({Channel::Specular, Encoding::Exact, kBright});
    else if (layout[Channel::Specular] != Encoding::Exact && storesFilms(scene))
        found.push_back({Channel::Specular, Encoding::Exact, kFilm});
    if (layout[Channel::Emission] != Encoding::Exact && scenes::anyDiffuses(scene, subsurface))
        found.push_back({Channel::Emission, Encoding::Exact, kDiffusion});
    else if (layout[Channel::Emission] != Encoding::Exact && scene.hook && scene.hook->changesSurfaces)
        found.push_back({Channel::Emission, Encoding::Exact, kHooked});
    return found;
}

GBufferLayout refined(GBufferLayout layout, const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface) {
    for (const Refinement& refinement : refinements(layout, scene, subsurface))
        layout.encoding[std::size_t(refinement.channel)] = refinement.encoding;
    return layout;
}

} // namespace tessera::frame
