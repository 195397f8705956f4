#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/edit/Bounded.h"
#include "viewer/edit/MaterialModel.h"
#include "viewer/edit/Thumbnail.h"
#include "viewer/panels/ChooseNamed.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

using scenes::Material;
using scenes::MaterialModel;

bool anisotropyRows(Material& material) {
    bool changed = slider("Anisotropy", material.anisotropyStrength, 0.0f, 1.0f);
    if (material.anisotropyStrength > 0.0f)
        changed |= angleSlider("Turned by", material.anisotropyRotationRadians, -180.0f, 180.0f);
    return changed;
}

bool transmissionRows(Material& material) {
    bool changed = slider("Transmission", material.transmission, 0.0f, 1.0f);
    if (material.transmission == 0.0f) return changed;
    changed |= logarithmicSlider("Thickness", material.thicknessMetres, 0.0f, kMostThicknessShown,
                                 material.thicknessMetres == 0.0f ? "a sheet" : "%.3g m");
    tip("Thickness of the body below the surface; a sheet bends no light");
    if (material.thicknessMetres == 0.0f) return changed;
    changed |= logarithmicSlider("Absorbs in", material.attenuationDistanceMetres, 0.0f, kMostThicknessShown,
                                 material.attenuationDistanceMetres == 0.0f ? "never" : "%.3g m");
    if (material.attenuationDistanceMetres > 0.0f) changed |= colorRow("Down to", material.attenuationColor);
    changed |= slider("Dispersion", material.dispersion, 0.0f, kMostDispersionShown);
    tip("20 over the Abbe number: 0.3 for crown glass, 0.6 for flint glass");
    return changed;
}

bool iridescenceRows(Material& material) {
    bool changed = slider("Iridescence", material.iridescence, 0.0f, 1.0f);
    if (material.iridescence == 0.0f) return changed;
    changed |= slider("Film index", material.iridescenceIor, 1.0f, kMostFilmIorShown);
    changed |= slider("Film nm", material.iridescenceThicknessNm, 0.0f, kMostFilmThicknessShown, "%.0f");
    tip("Thickness of the film in nanometres");
    if (material.texture(scenes::TextureSlot::IridescenceThickness).image == scenes::kNone) return changed;
    changed |= slider("Least nm", material.iridescenceLeastThicknessNm, 0.0f, kMostFilmThicknessShown, "%.0f");
    tip("Thickness of the film where the texture is 0, in nanometres");
    return changed;
}

bool layerRows(Material& material) {
    bool changed = slider("Clearcoat", material.clearcoat, 0.0f, 1.0f);
    if (material.clearcoat > 0.0f) changed |= slider("Coat rough", material.clearcoatPerceptualRoughness, 0.0f, 1.0f);
    changed |= colorRow("Sheen", material.sheenColor);
    if (material.sheenColor != glm::vec3(0.0f))
        changed |= slider("Sheen rough", material.sheenPerceptualRoughness, 0.0f, 1.0f);
    changed |= iridescenceRows(material);
    return changed | transmissionRows(material);
}

bool parameterRow(Material& material, const scenes::MaterialParameter& parameter, float Material::*member) {
    return slider(parameter.label, material.*member, parameter.leastShown, parameter.mostShown, parameter.format);
}

bool parameterRow(Material& material, const scenes::MaterialParameter& parameter, glm::vec3 Material::*member) {
    return colorRow(parameter.label, material.*member);
}

bool parameterRow(Material& material, const scenes::MaterialParameter& parameter, scenes::Masking Material::*member) {
    return chooseNamed(parameter.label, material.*member,
                       [&](scenes::Masking masking) { return scenes::supportsMasking(material.model, masking); });
}

bool modelRows(Material& material) {
    const scenes::MaterialModelInfo& model = scenes::infoOf(material.model);
    bool changed = false;
    for (const scenes::MaterialParameter& parameter : model.parameters)
        changed |= std::visit([&](auto member) { return parameterRow(material, parameter, member); }, parameter.member);
    if (model.anisotropy == scenes::Anisotropy::Strength) changed |= anisotropyRows(material);
    if (model.hasLayers) changed |= layerRows(material);
    return changed;
}

constexpr float kMostAbsorptionShown = 10.0f; // per millimetre: light gets a tenth of a millimetre deep

constexpr float kLeastScaleShown = 1e-3f, kMostScaleShown = 1e3f;

/// A named profile. A scene file's own profile is listed too, until another one is chosen.
bool profileRow(scenes::Subsurface& subsurface) {
    const std::span<const scenes::NamedProfile> named = scenes::namedProfiles();
    std::vector<Choice> choices;
    std::size_t now = named.size();
    for (std::size_t i = 0; i < named.size(); ++i) {
        choices.push_back({named[i].name, ""});
        if (scenes::profileOf(subsurface) == named[i].profile) now = i;
    }
    constexpr std::string_view kOwn = "of the scene file";
    if (now == named.size()) choices.push_back({kOwn, "Gaussians that the scene file gives"});
    const auto chosen = choose("Profile", choices[now].name, choices, now);
    if (!chosen || *chosen == named.size()) return false;
    subsurface.profile = named[*chosen].profile;
    return true;
}

bool subsurfaceRows(scenes::Subsurface& subsurface) {
    bool changed = chooseNamed("Subsurface", subsurface.method);
    const scenes::SubsurfaceMethodInfo& method = infoOf(subsurface.method);
    if (method.wraps) {
        changed |= slider("Wrap", subsurface.wrap, 0.0f, 1.0f);
        changed |= colorRow("Wrap tint", subsurface.wrapTint);
        changed |= logarithmicSlider("Body radius", subsurface.bodyRadiusMetres, 0.0f, kMostScaleShown,
                                     subsurface.bodyRadiusMetres == 0.0f ? "automatic" : "%.3g m");
        tip("Radius of the body that light reaches around, so that it does not shadow itself");
    }
    if (method.passes) {
        changed |= colorRow("Absorbs / mm", subsurface.absorptionPerMillimetre, kMostAbsorptionShown);
        changed |=
            logarithmicSlider("Scale", subsurface.scaleMetres, kLeastScaleShown, kMostScaleShown, "%.3g m a metre");
    }
    if (method.diffuses) {
        changed |= profileRow(subsurface);
        changed |= slider("Albedo before", subsurface.preScatterShare, 0.0f, 1.0f);
        tip("The part of the albedo that acts before diffusion is blurred; the rest stays sharp");
    }
    return changed;
}

bool surfaceRows(Material& material) {
    bool changed = chooseNamed("Alpha mode", material.alphaMode);
    if (material.alphaMode != scenes::AlphaMode::Opaque) changed |= slider("Opacity", material.baseColor.w, 0.0f, 1.0f);
    if (material.alphaMode == scenes::AlphaMode::Mask) changed |= slider("Cutoff", material.alphaCutoff, 0.0f, 1.0f);
    if (material.texture(scenes::TextureSlot::Normal).image != scenes::kNone)
        changed |= slider("Normal map", material.normalScale, 0.0f, kMostNormalScale, "x %.2f");
    row("Two sides");
    changed |= ImGui::Checkbox("##doubleSided", &material.doubleSided);
    if (scenes::isTransparent(material)) return changed; // transparent surfaces cast no shadow
    row("Shadow");
    changed |= ImGui::Checkbox("casts##material", &material.castsShadow);
    return changed;
}

/// Returns whether it was clicked.
bool drawThumbnail(const scenes::Image& image, float sidePoints) {
    constexpr int kPixels = 24;
    const Thumbnail small = thumbnailOf(image, kPixels);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool isClicked = ImGui::InvisibleButton("##thumbnail", {sidePoints, sidePoints});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float step = sidePoints / kPixels;
    for (int y = 0; y < small.sizePixels.y; ++y)
        for (int x = 0; x < small.sizePixels.x; ++x) {
            const glm::u8vec4& color = small.pixels[std::size_t(y * small.sizePixels.x + x)];
            const ImVec2 from(std::floor(corner.x + step * float(x)), std::floor(corner.y + step * float(y)));
            const ImVec2 to(std::floor(corner.x + step * float(x + 1)), std::floor(corner.y + step * float(y + 1)));
            list.AddRectFilled(from, to, IM_COL32(color.x, color.y, color.z, 255)); // opaque everywhere
        }
    return isClicked;
}

/// The textures that scale values, each as a thumbnail with its name. A click on the thumbnail shows the texture.
void textureRows(const Material& material, const std::vector<scenes::Image>& images, ResourceView& resource) {
    const float side = 2.0f * ImGui::GetFrameHeight();
    for (const scenes::TextureSlotInfo& slot : scenes::kTextureSlots) {
        const scenes::TextureUse& use = material.texture(slot.slot);
        if (use.image == scenes::kNone) continue;
        const scenes::Image& image = images[std::size_t(use.image)];
        ImGui::PushID(int(slot.slot));
        std::string label(slot.name);
        std::ranges::replace(label, '_', ' ');
        row(shortened(label, labelWidth()).c_str(), fmt::format("The {}, which scales values above", slot.what));
        const std::string name = image.name.empty() ? fmt::format("picture {}", use.image) : image.name;
        if (drawThumbnail(image, side)) resource.show(image, name);
        tip(fmt::format("{}, {} x {} texels, {} bits a channel; a click shows it", name, image.width, image.height,
                        2 * scenes::texelBytes(image.format)));
        ImGui::SameLine();
        ImGui::BeginGroup();
        ImGui::TextUnformatted(shortened(labelOf(name), ImGui::GetContentRegionAvail().x).c_str());
        ImGui::TextDisabled("%d x %d", image.width, image.height);
        ImGui::EndGroup();
        ImGui::PopID();
    }
}

bool materialRows(Material& material) {
    MaterialModel model = material.model;
    bool changed = chooseNamed("Model", model);
    if (changed) changeModel(material, model);
    glm::vec3 base(material.baseColor);
    if (colorRow("Colour", base)) {
        material.baseColor = glm::vec4(base, material.baseColor.w);
        changed = true;
    }
    changed |= modelRows(material);
    // Ignored for transmissive and iridescent materials.
    if (scenes::infoOf(material.model).isLit && !scenes::isTransmissive(material) && !scenes::isIridescent(material))
        changed |= subsurfaceRows(material.subsurface);
    changed |= colorRow("Emission", material.emissive, kMostRadiance);
    return changed | surfaceRows(material);
}

} // namespace

void materialsPanel(State& state) {
    if (!state.open) return;
    const std::vector<Material>& materials = state.open->scene().materials;
    if (state.selectedMaterial >= int(materials.size())) state.selectedMaterial = scenes::kNone;
    const auto nameOf = [&materials](std::size_t index) {
        const std::string& name = materials[index].name;
        return name.empty() ? fmt::format("material {}", index) : name;
    };
    std::string name; // of the entry being drawn
    const auto choiceAt = [&](std::size_t index) {
        name = nameOf(index);
        return Choice{name, ""};
    };
    const bool any = state.selectedMaterial != scenes::kNone;
    const auto now = std::size_t(any ? state.selectedMaterial : int(materials.size()));
    if (const auto chosen = choose("Material", any ? nameOf(now) : "click a surface", materials.size(), choiceAt, now))
        state.selectedMaterial = int(*chosen);
    tip("A click on a surface in the picture chooses its material");
    if (state.selectedMaterial == scenes::kNone)
        return paragraph(materials.empty() ? "This scene has no materials."
                                           : "Click a surface in the picture to edit its material.");
    state.showsMaterial = true;
    const auto index = std::size_t(state.selectedMaterial);
    Material edited = materials[index];
    if (materialRows(edited)) state.open->changeMaterial(index, std::move(edited), widgetGesture());
    textureRows(materials[index], state.open->scene().images, state.resource);
}

} // namespace tessera::viewer
