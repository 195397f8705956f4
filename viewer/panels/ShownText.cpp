#include "viewer/panels/ShownText.h"

namespace tessera::viewer {

void visitSceneText(const OpenScene& open, const TextVisitor& visit) {
    const scenes::Scene& scene = open.scene();
    visit(open.source());
    for (const scenes::Light& light : scene.lights) visit(light.name);
    for (const scenes::Material& material : scene.materials) visit(material.name);
    for (const scenes::Camera& camera : scene.cameras) visit(camera.name);
    for (const scenes::Clip& clip : scene.rig.clips) visit(clip.name);
    for (const std::string& variant : scene.variants) visit(variant);
    if (!scene.hook) return;
    for (const scenes::HookParameter& parameter : scene.hook->parameters) visit(parameter.name);
}

void visitShownText(const State& state, const TextVisitor& visit) {
    visit(state.notice.text);
    visit(state.loading);
    visit(state.loadingEnvironment);
    for (const std::string& file : state.recent) visit(file);
    for (const std::string& file : state.maps) visit(file);
    if (state.question) visit(state.question->scene);
    if (state.open) {
        const scenes::Scene& scene = state.open->scene();
        for (const std::string& note : scene.notes) visit(note);
        for (const std::string& warning : scene.warnings) visit(warning);
        if (scene.environment) visit(scene.environment->source);
    }
    if (!state.files) return;
    const FileDialog& dialog = *state.files;
    for (const std::string& text : {dialog.text(), dialog.fault(), dialog.reason()}) visit(text);
    if (dialog.folder()) visit(dialog.folder()->string());
    for (const FileEntry& entry : dialog.entries()) visit(entry.name);
}

} // namespace tessera::viewer
