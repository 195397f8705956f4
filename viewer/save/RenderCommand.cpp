#include "viewer/save/RenderCommand.h"

#include <algorithm>

#include <fmt/format.h>

#include "viewer/save/OptionText.h"

namespace tessera::viewer {
namespace {

/// The name in a table of the row for which `matches` holds; for tables without an infoOf().
template <typename Table, typename Matches>
std::string nameIn(const Table& table, Matches matches) {
    return std::string(std::ranges::find_if(table, matches)->name);
}

std::string techniqueName(recipes::Technique technique) {
    return std::string(infoOf(technique).name);
}

std::string layoutName(const frame::GBufferLayout& layout) {
    return nameIn(frame::layoutTable(), [&](const auto& row) { return row.layout == layout; });
}

std::string toneMapName(frame::ToneMap toneMap) {
    return nameIn(frame::toneMapTable(), [&](const auto& row) { return row.toneMap == toneMap; });
}

std::string sizeText(const glm::ivec2& sizePixels) {
    return fmt::format("{}x{}", sizePixels.x, sizePixels.y);
}

std::string onOff(bool isOn) {
    return isOn ? "on" : "off";
}

class CommandLine {
public:
    CommandLine(const RenderRequest& request, const scenes::Scene& scene)
        : request_(request), settings_(request.settings), scene_(scene) {}

    std::string options() {
        addWished();
        addCulling();
        addCamera();
        addRest();
        return text_;
    }

private:
    void add(const char* flag, const std::string& value) { text_ += fmt::format(" {} {}", flag, shellWord(value)); }

    /// Says what is not what the program does by itself.
    void addUnless(const char* flag, const std::string& value, const std::string& byItself) {
        if (value != byItself) add(flag, value);
    }

    /// What a scene may ask for: that is the default then.
    void addWished() {
        const scenes::SceneOptions& wish = scene_.options;
        const frame::FrameSettings standard;
        addUnless("--technique", techniqueName(request_.technique),
                  wish.technique.value_or(techniqueName(recipes::Technique::Deferred)));
        addUnless("--layout", layoutName(settings_.layout), wish.layout.value_or(layoutName(standard.layout)));
        addUnless("--size", sizeText(settings_.sizePixels), sizeText(wish.sizePixels.value_or(standard.sizePixels)));
        addUnless("--exposure", numberText(settings_.exposureEV),
                  numberText(wish.exposureEV.value_or(standard.exposureEV)));
        addUnless("--tonemap", toneMapName(settings_.toneMap), wish.toneMap.value_or(toneMapName(standard.toneMap)));
    }

    void addCulling() {
        const culling::Settings& culling = settings_.culling;
        if (culling.method) add("--culling", std::string(infoOf(*culling.method).name));
        if (culling.tilePixels) add("--tile", fmt::format("{}", *culling.tilePixels));
        if (culling.builder) add("--cull-on", std::string(infoOf(*culling.builder).name));
        if (settings_.lightOn) add("--light-on", std::string(infoOf(*settings_.lightOn).name));
    }

    void addCamera() {
        const auto firstCalled = [this](const std::string& name) {
            return int(std::ranges::find(scene_.cameras, name, &scenes::Camera::name) - scene_.cameras.begin());
        };
        const int byItself = scene_.options.camera ? firstCalled(*scene_.options.camera) : 0;
        if (settings_.camera != byItself) {
            const std::string& name = scene_.cameras[std::size_t(settings_.camera)].name;
            const bool isFirst = firstCalled(name) == settings_.camera && !name.empty();
            add("--camera", isFirst ? name : fmt::format("{}", settings_.camera));
        }
        text_ += poseText(request_.pose);
    }

    void addRest() {
        const frame::FrameSettings standard;
        const auto filterName = [&](const auto& row) { return row.filter == settings_.filter; };
        const auto spaceName = [&](const auto& row) { return row.space == settings_.space; };
        if (settings_.samples != standard.samples) add("--samples", fmt::format("{}", settings_.samples));
        if (settings_.timeSeconds != 0.0) add("--time", numberText(settings_.timeSeconds));
        if (request_.lights) add("--lights", fmt::format("{}", *request_.lights));
        if (!request_.defaultLight) text_ += " --no-default-light";
        if (settings_.rangeTolerance != 0.0) add("--range-tolerance", numberText(settings_.rangeTolerance));
        if (settings_.view != standard.view) add("--view", std::string(frame::viewInfo(settings_.view).name));
        if (settings_.soloLight) add("--solo", fmt::format("{}", *settings_.soloLight));
        if (settings_.specular != standard.specular) add("--specular", onOff(settings_.specular));
        if (settings_.filter != standard.filter) add("--filter", nameIn(frame::textureFilterTable(), filterName));
        if (settings_.space != standard.space) add("--space", nameIn(frame::lightingSpaceTable(), spaceName));
        if (settings_.prune != standard.prune) add("--prune", onOff(settings_.prune));
    }

    const RenderRequest& request_;
    const frame::FrameSettings& settings_;
    const scenes::Scene& scene_;
    std::string text_;
};

/// What begins with a dash would be taken for an option.
std::string argument(const std::string& path) {
    return shellWord(path.starts_with('-') ? "./" + path : path);
}

} // namespace

std::string renderCommand(const RenderRequest& request, const scenes::Scene& scene, const std::string& output) {
    return fmt::format("tessera render {}{} -o {}", argument(request.source), CommandLine(request, scene).options(),
                       argument(output));
}

} // namespace tessera::viewer
