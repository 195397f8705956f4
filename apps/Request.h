#pragma once
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/Settings.h"
#include "renderer/frame/PreparedView.h"
#include "renderer/gpu/Context.h"
#include "scenes/CameraChange.h"
#include "scenes/Load.h"

/// What is asked for in texts, on the command line or by a script, and its translation into the library's terms. Every
/// name is looked up in the library's tables, so an error can list the valid names.
namespace tessera::app {

/// The name of the reference renderer where a technique is expected.
inline constexpr const char* kReferenceName = "reference";

std::vector<std::string> contextNames(); ///< that --context takes
gpu::ContextKind contextKind(const std::string& name);
scenes::LightUnits lightUnitsNamed(const std::string& name);
scenes::ObjColours objColoursNamed(const std::string& name);

/// The options of a frame, common to all commands that draw or plan one. Unset ones take the scene's value, else the
/// default.
struct FrameOptions {
    std::string scene;
    std::map<std::string, std::string, std::less<>> settings; ///< texts, by the settings' keys
    std::optional<std::string> memoryLimit;
    std::optional<int> lights;
    bool noDefaultLight = false;
    bool defaultCamera = false;                ///< as scenes::LoadOptions has it
    std::optional<std::string> environment;    ///< the same
    std::optional<glm::dvec3> background;      ///< the same
    std::optional<std::string> clip;           ///< the same
    std::vector<scenes::HookValue> hookValues; ///< the same
    scenes::ImportWishes import;               ///< the same
    scenes::CameraChange pose;                 ///< of the camera that is chosen

    /// What was said of the setting of that key.
    std::optional<std::string> said(std::string_view key) const;
};
/// A scene and how to look at it.
struct Request : engine::ViewRequest {
    scenes::Scene scene;
    std::vector<std::string> files; ///< that the scene was read from
};
/// scenes::poseScene(), of which an error names the scene's file and the time.
void poseAt(scenes::Scene& scene, double timeSeconds, const std::string& file);

/// The scene alone, as the options have it: at the time that they, else the scene ask for, the camera they choose where
/// they place it.
/// Names of the files it was read from are added to `files`. Throws scenes::LoadStopped where a stop is requested.
scenes::Scene loadFor(const FrameOptions& options, std::vector<std::string>* files = nullptr,
                      std::stop_token stop = {});
/// What can be read without the scene: a mistake in it is found before a large scene is read for nothing.
Request resolveWithoutScene(const FrameOptions& options);
/// Options that name things of the request's scene, and the scene's own options where the command line sets none.
void resolveForScene(const FrameOptions& options, Request& request);
/// Places the camera that the options, else the scene choose, so that no clip moves it any more, and turns the light
/// along it that the scene was given for want of its own. Throws InputError for what no camera can have.
void placeCamera(const FrameOptions& options, scenes::Scene& scene);
/// Loads the scene, resolves every name, and when all is well warns of what the scene lacks. Throws InputError, and
/// scenes::LoadStopped as loadFor().
Request resolve(const FrameOptions& options, std::stop_token stop = {});
/// Warns of what the request's scene lacks, as resolve() does.
void warnOfScene(const scenes::Scene& scene);

/// A line of which cameras the scene has besides the one that is used; empty where there are none, or where the options
/// choose one or place their own.
std::string camerasText(const FrameOptions& options, const Request& request);

/// How loadScene() is asked for the scene. Throws InputError.
scenes::LoadOptions loadOptionsOf(const FrameOptions& options);

/// Why a setting, but those of shadows and of subsurface scattering, changes nothing of any picture of the request's
/// scene; empty: it may.
std::string whyUnheeded(const engine::Setting& setting, const Request& request);
/// "--flag changes nothing. Why": of a setting that was said.
std::string unheededText(const engine::Setting& setting, std::string why);
/// Which settings were said and surely change nothing of a picture by any of these techniques, nor of the reference
/// where it is drawn beside them, and why: a sentence or two each.
std::vector<std::string> unheededSettings(const FrameOptions& options, const Request& request,
                                          const frame::PreparedView& prepared,
                                          std::span<const engine::Technique> techniques, bool besideReference = false);
engine::Technique techniqueNamed(const std::string& name);
glm::ivec2 sizeNamed(const std::string& flag, const std::string& text);

} // namespace tessera::app
