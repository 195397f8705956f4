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

/// Requests as text, from the command line or a script, and their translation into the library's types. Names are
/// looked up in the library's tables, so errors can list the valid ones.
namespace tessera::app {

/// The name of the reference renderer where a technique is expected.
inline constexpr const char* kReferenceName = "reference";

std::vector<std::string> contextNames(); ///< values of --context
gpu::ContextKind contextKind(const std::string& name);
scenes::LightUnits lightUnitsNamed(const std::string& name);
scenes::ObjColours objColoursNamed(const std::string& name);

/// The options of a frame, common to all commands that draw or plan one. Unset ones take the scene's value, else the
/// default.
struct FrameOptions {
    std::string scene;
    std::map<std::string, std::string, std::less<>> settings; ///< text by setting key
    std::optional<std::string> memoryLimit;
    std::optional<int> lights;
    bool noDefaultLight = false;
    bool defaultCamera = false;                ///< see scenes::LoadOptions
    std::optional<std::string> environment;    ///< the same
    std::optional<glm::dvec3> background;      ///< the same
    std::optional<std::string> clip;           ///< the same
    std::vector<scenes::HookValue> hookValues; ///< the same
    scenes::ImportOptions import;              ///< the same
    scenes::CameraChange pose;                 ///< of the selected camera

    /// The given text of a setting, if any.
    std::optional<std::string> said(std::string_view key) const;
};
/// A scene and how to look at it.
struct Request : engine::ViewRequest {
    scenes::Scene scene;
    std::vector<std::string> files; ///< read for the scene
};
/// scenes::poseScene() with errors that name the scene's file and the time.
void poseAt(scenes::Scene& scene, double timeSeconds, const std::string& file);

/// Loads the scene, poses it at the time of the options, else of the scene, and calls placeCamera(). Appends the names
/// of the files it reads to `files`. Throws scenes::LoadStopped if a stop is requested.
scenes::Scene loadFor(const FrameOptions& options, std::vector<std::string>* files = nullptr,
                      std::stop_token stop = {});
/// Resolves the options that need no scene, so that their mistakes are found before a large scene is read.
Request resolveWithoutScene(const FrameOptions& options);
/// Resolves the options that refer to the request's scene, and the scene's options where the command line sets none.
void resolveForScene(const FrameOptions& options, Request& request);
/// Applies the camera change to the camera selected by the options, else by the scene. Clips no longer animate what it
/// changes. Throws InputError for invalid camera parameters.
void placeCamera(const FrameOptions& options, scenes::Scene& scene);
/// Loads the scene, resolves every name and, on success, calls warnOfScene(). Throws InputError, and
/// scenes::LoadStopped like loadFor().
Request resolve(const FrameOptions& options, std::stop_token stop = {});
/// Logs the scene's warnings, active clip, supplied parts and notes.
void warnOfScene(const scenes::Scene& scene);

/// One line that lists the scene's other cameras; empty if there are none, or the options select or place one.
std::string camerasText(const FrameOptions& options, const Request& request);

/// The arguments of loadScene(). Throws InputError.
scenes::LoadOptions loadOptionsOf(const FrameOptions& options);

/// Why a setting, except those of shadows and subsurface scattering, changes no image of the request's scene; empty: it
/// may change one.
std::string whyUnused(const engine::Setting& setting, const Request& request);
/// Warning "--flag changes nothing. Why" for a given setting.
std::string unusedText(const engine::Setting& setting, std::string why);
/// Warnings for given settings that certainly change no image of these techniques, nor of the reference if drawn too:
/// one or two sentences each.
std::vector<std::string> unusedSettings(const FrameOptions& options, const Request& request,
                                        const frame::PreparedView& prepared,
                                        std::span<const engine::Technique> techniques, bool besideReference = false);
engine::Technique techniqueNamed(const std::string& name);
glm::ivec2 sizeNamed(const std::string& flag, const std::string& text);

} // namespace tessera::app
