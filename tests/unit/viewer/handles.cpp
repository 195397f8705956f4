// A light's outline and handles, drawn without a window.
#include <algorithm>
#include <cmath>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Handles.h"

namespace tessera::viewer {
namespace {

class Handles : public test::PanelTest {
protected:
    /// A rectangle ahead of the camera that faces down in the image.
    Handles() {
        scenes::Light light;
        const glm::dmat4 worldFromCamera = scenes::loadScene("room").cameras.front().worldFromCamera;
        light.type = scenes::LightType::Rectangle;
        light.positionWS = worldFromCamera * glm::dvec4(0.0, 0.0, -3.0, 1.0);
        light.directionWS = -glm::dvec3(worldFromCamera[1]);
        light.alongWS = glm::dvec3(worldFromCamera[0]);
        state_ = test::stateOf(test::roomWith({light}));
        state_.selectedLight = 0;
    }
    template <typename Change>
    void change(const Change& change) {
        test::changeLight(state_, 0, change);
    }
    auto span() {
        return overlaySpan([&] { drawHandles(state_, area(state_)); });
    }
    /// Returns the mouse cursor at a place in the image.
    ImGuiMouseCursor cursorAt(const glm::dvec2& place) {
        const PictureArea at = area(state_);
        return PanelTest::cursorAt({at.corner.x + float(place.x), at.corner.y + float(place.y)},
                                   [&] { drawHandles(state_, at); });
    }

    State state_;
};

TEST_F(Handles, areDrawnOfTheSelectedLightAlone) {
    EXPECT_TRUE(span());
    state_.selectedLight = scenes::kNone;
    EXPECT_FALSE(span());
    state_.selectedLight = 1; // was deleted
    EXPECT_FALSE(span());
}

TEST_F(Handles, stayInThePictureHoweverLargeTheLightIs) {
    const PictureArea at = area(state_);
    constexpr float kHalfLine = 4.0f; // half of the line's width, with its smooth rim
    for (const float metres : {10.0f, 1e6f}) {
        change([&](scenes::Light& light) { light.widthMetres = light.heightMetres = metres; }); // behind the camera
        const auto drawn = span();
        ASSERT_TRUE(drawn);
        EXPECT_GE(drawn->first, at.corner.x - kHalfLine);
        EXPECT_LE(drawn->second, at.corner.x + at.size.x + kHalfLine);
    }
    const glm::dmat4& worldFromCamera = state_.open->scene().cameras[0].worldFromCamera;
    change([&](scenes::Light& light) {
        light.positionWS = glm::dvec3(worldFromCamera * glm::dvec4(0.0, 0.0, 3.0, 1.0));
        light.widthMetres = light.heightMetres = 0.5f;
    });
    EXPECT_FALSE(span()) << "all of it lies behind the camera";
}

TEST_F(Handles, thePointerSaysWhatAPressDoes) {
    const LightFigure figure = *selectedFigure(state_, area(state_));
    const auto arms = std::ranges::count(figure.handles, true, &LightHandle::moves);
    ASSERT_EQ(figure.handles.size() - std::size_t(arms), 3u) << "its height points at the viewer";
    EXPECT_EQ(arms, 3) << "the camera looks askew into the room";
    for (const LightHandle& handle : figure.handles) {
        const ImGuiMouseCursor cursor = cursorAt(handle.place);
        if (handle.arm == 1) {
            EXPECT_EQ(cursor, ImGuiMouseCursor_ResizeNS) << "the camera is not rolled";
        } else if (handle.moves()) {
            EXPECT_NE(cursor, ImGuiMouseCursor_Arrow) << handle.arm;
        } else {
            EXPECT_EQ(cursor, handle.turns() ? ImGuiMouseCursor_Hand : ImGuiMouseCursor_ResizeEW);
        }
    }
    EXPECT_EQ(cursorAt({3.0, 3.0}), ImGuiMouseCursor_Arrow);
    state_.heldHandle = figure.handles[0].number;
    EXPECT_EQ(cursorAt({3.0, 3.0}), ImGuiMouseCursor_ResizeEW) << "it is held, wherever the pointer went";
}

TEST_F(Handles, anArmHasTheColourOfItsAxis) {
    const PictureArea at = area(state_);
    const LightFigure figure = *selectedFigure(state_, at);
    int arms = 0;
    for (const LightHandle& handle : figure.handles) {
        if (!handle.moves()) continue;
        ++arms;
        const glm::vec2 end = at.corner + glm::vec2(handle.place);
        int ownColour = 0;
        for (const ImDrawVert& vertex : overlay([&] { drawHandles(state_, at); })) {
            const ImVec4 ink = ImGui::ColorConvertU32ToFloat4(vertex.col);
            const float channels[] = {ink.x, ink.y, ink.z};
            if (glm::distance(glm::vec2(vertex.pos.x, vertex.pos.y), end) > 9.0f || ink.w < 1.0f) continue;
            constexpr float kBrighter = 0.25f; // than both others
            const float own = channels[handle.arm];
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_TRUE(axis == handle.arm || own > channels[axis] + kBrighter) << handle.arm;
            ++ownColour;
        }
        EXPECT_GE(ownColour, 3) << "its head has three corners: " << handle.arm;
    }
    EXPECT_EQ(arms, 3);
}

TEST_F(Handles, wordsBesideThePointerNameTheAxisOfAnArm) {
    const PictureArea at = area(state_);
    const LightFigure figure = *selectedFigure(state_, at);
    const auto arm = std::ranges::find(figure.handles, 0, &LightHandle::arm);
    ASSERT_NE(arm, figure.handles.end());
    const auto verticesAt = [&](const glm::dvec2& place) {
        cursorAt(place);
        return overlay([&] { drawHandles(state_, at); }).size();
    };
    constexpr std::size_t kWordsVertices = 16 * 4; // "Drag to move along x" without its spaces
    const std::size_t without = verticesAt({3.0, 3.0});
    EXPECT_GE(verticesAt(arm->place), without + kWordsVertices);
    EXPECT_EQ(verticesAt(figure.handles.at(0).place), without) << "that one's outline shows what it does";
    state_.heldHandle = arm->number;
    EXPECT_EQ(verticesAt(arm->place), without) << "a drag has its own words";
}

TEST_F(Handles, noPointerIsThePlainOneWhateverTheWay) {
    // Rotated about the line of sight, the width takes all directions. GLFW 3.3 has no diagonal arrows.
    const glm::dmat4& worldFromCamera = state_.open->scene().cameras[0].worldFromCamera;
    const glm::dvec3 rightWS(worldFromCamera[0]), upWS(worldFromCamera[1]);
    constexpr ImGuiMouseCursor kWithoutSlants[] = {ImGuiMouseCursor_ResizeEW, ImGuiMouseCursor_Hand,
                                                   ImGuiMouseCursor_ResizeNS, ImGuiMouseCursor_Hand};
    constexpr ImGuiMouseCursor kWithSlants[] = {ImGuiMouseCursor_ResizeEW, ImGuiMouseCursor_ResizeNESW,
                                                ImGuiMouseCursor_ResizeNS, ImGuiMouseCursor_ResizeNWSE};
    for (int eighth = 0; eighth < 4; ++eighth) {
        const double angle = glm::radians(45.0 * eighth);
        change([&](scenes::Light& light) {
            light.alongWS = std::cos(angle) * rightWS + std::sin(angle) * upWS;
            light.directionWS = std::sin(angle) * rightWS - std::cos(angle) * upWS;
        });
        const LightFigure figure = *selectedFigure(state_, area(state_));
        const auto width = std::ranges::find_if(figure.handles, [](const LightHandle& handle) {
            return handle.parameter != nullptr && handle.parameter->member == &scenes::Light::widthMetres;
        });
        ASSERT_NE(width, figure.handles.end());
        const ImGuiMouseCursor cursor = cursorAt(width->place);
        EXPECT_TRUE(cursor == kWithoutSlants[eighth] || cursor == kWithSlants[eighth]) << eighth << ": " << cursor;
    }
}

TEST_F(Handles, theSelectedMaterialIsOutlinedWhileAPanelShowsIt) {
    const PictureArea at = area(state_);
    Facts facts;
    const auto outline = [&] { return overlaySpan([&] { drawMaterialOutline(state_, facts, at); }); };
    state_.selectedMaterial = 1;
    state_.showsMaterial = true;
    EXPECT_FALSE(outline()) << "it is not found yet";
    // The outline is of an image of half the size.
    facts.materialOutline = {1, glm::ivec2(at.size) / 2, {{{10.0f, 20.0f}, {60.0f, 20.0f}, {60.0f, 40.0f}}}};
    const auto drawn = outline();
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(drawn->first, at.corner.x + 20.0f, 4.0f);
    EXPECT_NEAR(drawn->second, at.corner.x + 120.0f, 4.0f);
    state_.selectedMaterial = 0;
    EXPECT_FALSE(outline()) << "that is another's";
    state_.selectedMaterial = 1;
    state_.showsMaterial = false;
    EXPECT_FALSE(outline()) << "the panel is folded";
}

TEST_F(Handles, theValueOfADragStandsBesideThePointerAndInThePicture) {
    const PictureArea at = area(state_);
    const auto text = [&] { return overlaySpan([&] { drawDragText(state_, at); }); };
    EXPECT_FALSE(text());
    state_.dragText = "Width 1.25 m";
    for (const float x : {at.corner.x + 100.0f, at.corner.x + at.size.x - 1.0f, -50.0f}) {
        ImGui::GetIO().MousePos = {x, 100.0f};
        const auto drawn = text();
        ASSERT_TRUE(drawn);
        EXPECT_GE(drawn->first, at.corner.x - 1.0f);
        EXPECT_LE(drawn->second, at.corner.x + at.size.x + 1.0f);
    }
}

} // namespace
} // namespace tessera::viewer
