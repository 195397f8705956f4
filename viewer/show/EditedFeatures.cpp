#include "viewer/show/EditedFeatures.h"

#include "renderer/frame/MaterialFeatures.h"
#include "scenes/Shadows.h"

namespace tessera::viewer {

frame::FeatureSet editedFeatures(const scenes::Scene& scene) {
    using frame::Feature;
    frame::FeatureSet features = frame::materialFeatures(scene);
    for (const scenes::Light& light : scene.lights) {
        if (!light.enabled || light.intensity * light.color == glm::vec3(0.0f)) continue;
        features.add(frame::featureOf(light.type));
        features.add(Feature::AttenuationLights, light.falloff == scenes::Falloff::Attenuation);
        features.add(Feature::LightPictures, bool(light.texture));
        features.add(Feature::Shadows, light.castsShadow);
        features.add(Feature::SoftShadows, light.castsShadow && scenes::hasSize(light));
    }
    features.add(Feature::Environment, scene.environment && scene.environment->intensity > 0.0f);
    return features;
}

} // namespace tessera::viewer
