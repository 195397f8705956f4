#pragma once
#include <span>

#include "viewer/session/State.h"

/// Edits and undoing, as far as they concern more than the scene: which light is selected, which one shines alone, and
/// how looks show the environment. Without a scene they do nothing.
namespace tessera::viewer {

/// Adds a light in the picture's middle, which suits a picture of this mean luminance (AddedLight.h), or copies of the
/// selected ones, at the end of the list, and selects what it adds. Nothing happens where there would be more than a
/// scene can have.
void addLight(State& state, double meanLuminance);
void duplicateSelectedLights(State& state);

/// Gives the selected light other values, in one step with all that are selected with it: what was changed of it
/// becomes theirs, but a place, by which they move alike. Its name, and how it moves by itself, are its own.
/// `sceneSizeMetres` is for lights that become area lights.
void changeSelectedLights(State& state, const scenes::Light& changed, double sceneSizeMetres,
                          Gesture gesture = Gesture::Once);
/// Switches lights on or off, in one step.
void switchLights(State& state, std::span<const int> lights, bool isOn);

/// Begins to ask for another name of the selected light, and takes what was typed: as it is, or with a number behind it
/// where another light has that name. An empty one changes nothing.
void beginRenaming(State& state);
void endRenaming(State& state);

/// Deletes the lights that are selected, if any are, in one step. The light that follows is selected then, else the
/// last one; none while something is dragged.
void deleteSelectedLights(State& state);

/// How a choice goes with those that were selected before.
enum class Choosing : std::uint8_t {
    Alone,  ///< in their place; a light that was selected alone is let go of
    Toggle, ///< besides them, or no longer
    Range   ///< with all from the selected one on, in the order of the list
};
/// Without a list in the order of the scene.
void selectLight(State& state, int index, Choosing choosing, std::span<const int> list = {});
/// Selects several in the place of all others, or besides them.
void selectLights(State& state, std::span<const int> lights, bool isBeside);
void selectAllLights(State& state);

/// Puts the lights that State::scatter describes in the place of the scene's. The next time the scattered ones lie
/// elsewhere. Traces rays at the scene's surfaces, which may take seconds. Throws std::runtime_error when memory runs
/// out, and the lights stay as they are.
void replaceByScattered(State& state);

/// Turns and brightens the environment in all looks. Without one nothing happens.
void viewEnvironment(State& state, const scenes::EnvironmentView& view, Gesture gesture = Gesture::Once);

/// Takes the latest edit or jump of the camera back, or brings back what was taken back last. The light or material
/// that it was about is selected. While something is dragged, nothing happens.
void undo(State& state);
void redo(State& state);

/// Undoes or redoes as many edits as lead to the scene as it was saved; where none do, asks for its file to be opened
/// again.
void revert(State& state);

} // namespace tessera::viewer
