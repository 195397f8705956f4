#pragma once
#include <span>

#include "viewer/session/State.h"

/// Edits and undo that also affect the selection, the solo light, and the environment of the looks. They do nothing
/// without a scene.
namespace tessera::viewer {

/// Adds a light at the image centre that suits an image of this mean luminance (AddedLight.h), or copies of the
/// selected lights, at the end of the list, and selects them. No effect beyond the scene's limit of lights.
void addLight(State& state, double meanLuminance);
void duplicateSelectedLights(State& state);

/// Changes the selected light and, in the same step, all lights selected with it: they take the changed values, and
/// move by the same offset. Name and animation are not copied. `sceneSizeMetres` sets the size of lights that become
/// area lights.
void changeSelectedLights(State& state, const scenes::Light& changed, double sceneSizeMetres,
                          Gesture gesture = Gesture::Once);
/// Switches lights on or off, in one step.
void switchLights(State& state, std::span<const int> lights, bool isOn);

/// Starts renaming the selected light, and ends it with the typed name, followed by a number if another light has it.
/// An empty name changes nothing.
void beginRenaming(State& state);
void endRenaming(State& state);

/// Deletes the selected lights in one step, and selects the light that follows, else the last one; none during a drag.
void deleteSelectedLights(State& state);

/// How a click changes the selection.
enum class Choosing : std::uint8_t {
    Alone,  ///< replaces it; deselects a light that was selected alone
    Toggle, ///< adds the light, or removes it
    Range   ///< adds all from the selected one on, in the order of the list
};
/// Without a list, in the order of the scene.
void selectLight(State& state, int index, Choosing choosing, std::span<const int> list = {});
/// Selects several lights in place of the others, or in addition to them.
void selectLights(State& state, std::span<const int> lights, bool isBeside);
void selectAllLights(State& state);

/// Replaces the scene's lights by those that State::scatter describes; the next call places them differently. Traces
/// rays against the scene's surfaces, which may take seconds. Throws std::runtime_error when memory runs out; the
/// lights then stay.
void replaceByScattered(State& state);

/// Rotates and scales the environment in all looks. No effect without an environment.
void viewEnvironment(State& state, const scenes::EnvironmentView& view, Gesture gesture = Gesture::Once);

/// Undoes the latest edit or jump of the camera, or redoes the last undone one, and selects the light or material that
/// it changed. No effect during a drag.
void undo(State& state);
void redo(State& state);

/// Undoes or redoes back to the saved scene. If no steps lead there, requests its file to be opened again.
void revert(State& state);

} // namespace tessera::viewer
