// The rows of a light, by its type.
#include <memory>

#include <fmt/format.h>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Panels.h"

namespace tessera::viewer {
namespace {

class LightRows : public test::PanelTest {};

TEST_F(LightRows, areThoseOfItsTypeAndNoOther) {
    const auto isIn = [](const std::string& text, const std::string& label) {
        return text.find("\n" + label + " ") != std::string::npos ||
               text.find("\n" + label + "\n") != std::string::npos;
    };
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        scenes::Scene scene = scenes::loadScene("room", {});
        scene.lights.assign(1, {});
        scene.lights[0].type = type.type;
        State state;
        state.open =
            std::make_unique<OpenScene>("room", scenes::LoadOptions(), std::move(scene), scenes::SceneOrigin());
        state.selectedLight = 0;
        const std::string text = textOf([&] { lightsPanel(state); });
        const auto hasRow = [&](const scenes::LightParameter& parameter) { return isIn(text, parameter.label); };
        for (const scenes::LightTypeInfo& other : scenes::lightTypes()) {
            for (const scenes::LightParameter& parameter : other.parameters)
                EXPECT_EQ(hasRow(parameter), other.type == type.type) << type.name << parameter.label << " in" << text;
            if (const scenes::LightParameter* size = scenes::sizeParameter(other)) {
                EXPECT_EQ(hasRow(*size), size == scenes::sizeParameter(type)) << type.name << " in" << text;
            }
        }
        EXPECT_EQ(isIn(text, "Shines"), type.isFlat) << text;
        EXPECT_EQ(isIn(text, "Surface"), type.isArea) << text;
        EXPECT_EQ(isIn(text, "Width along"), type.hasSides()) << text;
        EXPECT_EQ(isIn(text, "Range"), type.hasPosition()) << text;
        EXPECT_NE(text.find(fmt::format(" {} }}\n", type.unit)), std::string::npos) << type.unit << " in" << text;
    }
}

} // namespace
} // namespace tessera::viewer
