#pragma once
#include "viewer/session/State.h"

/// Edits and undoing, as far as they concern more than the scene: which light is selected, which one shines alone, and
/// how looks show the environment. Without a scene they do nothing.
namespace tessera::viewer {

/// Adds a light in the picture's middle, which suits a picture of this mean luminance (AddedLight.h), or a copy of the
/// selected one, at the end of the list, and selects it. Nothing happens where there are as many as a scene can have.
void addLight(State& state, double meanLuminance);
void duplicateSelectedLight(State& state);

/// Deletes the lights that are selected, if any are, in one step. The light that follows is selected then, else the
/// last one; none while something is dragged.
void deleteSelectedLights(State& state);

/// How a choice goes with those that were selected before.
enum class Choosing : std::uint8_t {
    Alone,  ///< in their place; a light that was selected alone is let go of
    Toggle, ///< besides them, or no longer
    Range   ///< with all from the selected one on
};
void selectLight(State& state, int index, Choosing choosing);
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
