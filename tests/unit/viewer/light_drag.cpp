#include <algorithm>

#include "scenes/AreaLight.h"
#include "tests/unit/viewer/HandleTest.h"
#include "viewer/edit/LightDrag.h"

namespace tessera::viewer {
namespace {

constexpr glm::dvec2 kDragPicture{1000.0, test::kHeightPixels};

/// A light away from the origin.
scenes::Light draggedLight(scenes::LightType type) {
    return test::askewLight(type, {0.4, 1.2, -0.3});
}

std::vector<PictureView> dragViews() {
    return test::twoViews({1.0, 1.9, 4.0}, {0.3, 1.0, 0.0});
}

/// Returns a light after a drag of its handle, with the pointer slightly beside it.
scenes::Light draggedBy(const scenes::Light& light, const PictureView& view, const LightHandle& handle,
                        const glm::dvec2& way, bool isOneSided = false) {
    const glm::dvec2 pointer = handle.place + glm::dvec2(3.0, -2.0);
    scenes::Light changed = light;
    LightDrag drag(light, lightFigure(light, view, 1.0), handle, view, pointer);
    drag.drag(changed, 0.0, view, pointer + 0.4 * way, isOneSided);
    drag.drag(changed, 0.0, view, pointer + way, isOneSided);
    return changed;
}

/// Returns the handle of this number after an edit.
LightHandle sameHandle(const scenes::Light& light, const PictureView& view, int number) {
    const LightFigure figure = lightFigure(light, view, 1.0);
    const auto found = std::ranges::find(figure.handles, number, &LightHandle::number);
    return found == figure.handles.end() ? LightHandle() : *found;
}

TEST(LightDrag, aLineAndAnAxisAreNearestWhereTheirCommonNormalMeetsTheAxis) {
    // The axis is along x at height 1, the line along z at height 3 and x = 2.5.
    const SightLine line{{2.5, 3.0, 7.0}, {0.0, 0.0, -1.0}};
    const glm::dvec3 middleWS(0.5, 1.0, 0.0), axisWS(1.0, 0.0, 0.0);
    EXPECT_NEAR(metresAlongAxis(line, middleWS, axisWS).value(), 2.0, 1e-12);
    EXPECT_NEAR(metresAlongAxis(line, middleWS, -axisWS).value(), -2.0, 1e-12);
    EXPECT_FALSE(metresAlongAxis({{2.5, 3.0, -7.0}, {0.0, 0.0, -1.0}}, middleWS, axisWS)) << "behind its origin";
    EXPECT_FALSE(metresAlongAxis(line, middleWS, {0.0, 0.0, 1.0})) << "parallel";
}

TEST(LightDrag, aLineMeetsASphereTwiceOrComesNearestToItsRim) {
    const glm::dvec3 middleWS(1.0, 0.0, 0.0);
    const SightLine line{{1.0, 3.0, 10.0}, {0.0, 0.0, -1.0}};
    const SpherePoint near = pointOnSphere(line, middleWS, 5.0, false), far = pointOnSphere(line, middleWS, 5.0, true);
    EXPECT_LT(glm::distance(near.directionWS, glm::dvec3(0.0, 0.6, 0.8)), 1e-12);
    EXPECT_LT(glm::distance(far.directionWS, glm::dvec3(0.0, 0.6, -0.8)), 1e-12);
    EXPECT_FALSE(near.isBeside);
    const SpherePoint beside = pointOnSphere(line, middleWS, 2.0, false);
    EXPECT_TRUE(beside.isBeside);
    EXPECT_LT(glm::distance(beside.directionWS, glm::dvec3(0.0, 1.0, 0.0)), 1e-12);
    // From inside there is only one side.
    const SpherePoint inside = pointOnSphere({{1.0, 3.0, 0.0}, {0.0, 0.0, -1.0}}, middleWS, 5.0, false);
    EXPECT_LT(glm::distance(inside.directionWS, glm::dvec3(0.0, 0.6, -0.8)), 1e-12);
}

TEST(LightDrag, everyHandleOfAShapeGoesWithThePointerAndBack) {
    for (const PictureView& view : dragViews())
        for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
            const scenes::Light light = draggedLight(type.type);
            for (const LightHandle& handle : lightFigure(light, view, 1.0).handles) {
                if (handle.parameter == nullptr) continue;
                SCOPED_TRACE(std::string(type.name) + " " + handle.parameter->label);
                const glm::dvec2 way = 25.0 * handle.way;
                const scenes::Light larger = draggedBy(light, view, handle, way);
                EXPECT_GT(larger.*handle.parameter->member, light.*handle.parameter->member);
                EXPECT_EQ(larger.positionWS, light.positionWS);
                // A round outline's handle is where lines of sight touch it, which turns slightly as the radius grows.
                const double pixels = handle.isRound ? 3.0 : 0.01;
                EXPECT_LT(glm::distance(sameHandle(larger, view, handle.number).truePlace, handle.truePlace + way),
                          pixels);
                const scenes::Light back = draggedBy(light, view, handle, {0.0, 0.0});
                EXPECT_NEAR(back.*handle.parameter->member, light.*handle.parameter->member, 1e-6);
                // Dragging far past the middle gives 0.
                if (!handle.isRound) {
                    EXPECT_EQ(draggedBy(light, view, handle, -250.0 * handle.way).*handle.parameter->member, 0.0f);
                }
            }
        }
}

TEST(LightDrag, ofOneSideTheOppositeOneStays) {
    for (const PictureView& view : dragViews())
        for (const scenes::LightType type : {scenes::LightType::Rectangle, scenes::LightType::Tube}) {
            scenes::Light light = draggedLight(type);
            light.animation.emplace().centerWS = light.positionWS - glm::dvec3(1.0, 0.0, 0.0);
            light.positionWS = scenes::lightAtTime(light, 0.0).positionWS;
            for (const LightHandle& handle : lightFigure(light, view, 1.0).handles) {
                if (handle.parameter == nullptr || handle.isRound) continue;
                SCOPED_TRACE(handle.parameter->label);
                const scenes::Light moved = draggedBy(light, view, handle, 20.0 * handle.way, true);
                const auto endWS = [&](const scenes::Light& of, double side) {
                    const double halfMetres = 0.5 * double(of.*handle.parameter->member);
                    return scenes::lightAtTime(of, 0.0).positionWS + side * halfMetres * handle.axisWS;
                };
                EXPECT_GT(moved.*handle.parameter->member, light.*handle.parameter->member);
                EXPECT_LT(glm::distance(endWS(moved, -1.0), endWS(light, -1.0)), 1e-6);
                const glm::dvec2 shown = view.placeOf(endWS(moved, 1.0)).value();
                EXPECT_LT(glm::distance(shown, handle.truePlace + 20.0 * handle.way), 0.01);
                EXPECT_LT(
                    glm::distance(
                        scenes::lightAtTime(light, 0.0).positionWS,
                        scenes::lightAtTime(draggedBy(light, view, handle, glm::dvec2(0.0), true), 0.0).positionWS),
                    1e-6);
            }
        }
}

TEST(LightDrag, aCornerGoesWithThePointerInItsPlaneAndNotWhereItMakesNoOutline) {
    const scenes::Light light = draggedLight(scenes::LightType::Polygon);
    for (const PictureView& view : dragViews())
        for (const LightHandle& handle : lightFigure(light, view, 1.0).handles) {
            if (handle.corner == scenes::kNone) continue;
            SCOPED_TRACE(handle.corner);
            const glm::dvec2 way(12.0, -15.0);
            const scenes::Light moved = draggedBy(light, view, handle, way);
            scenes::Light expected = light; // only that corner changes
            expected.corners.metres[std::size_t(handle.corner)] = moved.corners.metres[std::size_t(handle.corner)];
            EXPECT_TRUE(moved == expected);
            // In pixels of 1000; the corner is rounded to single precision.
            EXPECT_LT(glm::distance(sameHandle(moved, view, handle.number).truePlace, handle.truePlace + way), 0.01);
            const scenes::Light back = draggedBy(light, view, handle, {0.0, 0.0});
            const std::size_t i = std::size_t(handle.corner);
            EXPECT_LT(glm::distance(back.corners.metres[i], light.corners.metres[i]), 1e-6f);
            // Beyond the edge between the next corner and the opposite one, so that edges would cross.
            const auto placeOf = [&](int number) { return sameHandle(light, view, number % 4).truePlace; };
            const glm::dvec2 middle = view.placeOf(light.positionWS).value();
            const glm::dvec2 edge = 0.5 * (placeOf(handle.number + 1) + placeOf(handle.number + 2));
            scenes::Light crossed = light;
            LightDrag drag(light, lightFigure(light, view, 1.0), handle, view, handle.truePlace);
            EXPECT_FALSE(drag.drag(crossed, 0.0, view, middle + 1.3 * (edge - middle), false));
            EXPECT_TRUE(crossed == light);
        }
}

/// A hundred roundings of double precision at 5 m to the eye, over the square of the sine of 12 degrees.
constexpr double kArmRoundingMetres = 3e-12;

TEST(LightDrag, anArmMovesItsLightAlongItsAxisAlone) {
    for (const PictureView& view : dragViews())
        for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
            const scenes::Light light = draggedLight(type.type);
            int arms = 0;
            for (const LightHandle& handle : lightFigure(light, view, 1.0).handles) {
                if (!handle.moves()) continue;
                SCOPED_TRACE(std::string(type.name) + " " + handle.axisName());
                ++arms;
                const glm::dvec2 way = 25.0 * handle.way;
                for (const bool isOneSided : {false, true}) {
                    const scenes::Light moved = draggedBy(light, view, handle, way, isOneSided);
                    EXPECT_GT(moved.positionWS[handle.arm], light.positionWS[handle.arm]);
                    scenes::Light expected = light; // only that coordinate changes, to the last bit
                    expected.positionWS[handle.arm] = moved.positionWS[handle.arm];
                    EXPECT_TRUE(moved == expected);
                    const glm::dvec3 endWS = handle.positionWS + moved.positionWS - light.positionWS;
                    // Rounding, in pixels of 1000.
                    EXPECT_LT(glm::distance(view.placeOf(endWS).value(), handle.truePlace + way), 1e-4);
                }
                // A drag across its direction goes to the nearest point of its axis.
                const glm::dvec2 across(-handle.way.y, handle.way.x);
                const scenes::Light beside = draggedBy(light, view, handle, way + 5.0 * across);
                scenes::Light expected = light;
                expected.positionWS[handle.arm] = beside.positionWS[handle.arm];
                EXPECT_TRUE(beside == expected);
                const scenes::Light back = draggedBy(light, view, handle, {0.0, 0.0});
                EXPECT_LT(glm::distance(back.positionWS, light.positionWS), kArmRoundingMetres);
            }
            EXPECT_EQ(arms, type.hasPosition() ? 3 : 0);
        }
}

TEST(LightDrag, anArmTakesThePathOfAMovingLightWithItWhateverTheTimeNow) {
    constexpr double kTakenSeconds = 0.4, kNowSeconds = 0.7;
    const PictureView view = dragViews()[0];
    scenes::Light light = draggedLight(scenes::LightType::Point);
    light.animation.emplace().centerWS = light.positionWS - glm::dvec3(0.2, 0.0, 0.0);
    const LightFigure figure = lightFigure(scenes::lightAtTime(light, kTakenSeconds), view, 1.0);
    const auto handle = std::ranges::find(figure.handles, 1, &LightHandle::arm);
    ASSERT_NE(handle, figure.handles.end());
    scenes::Light moved = light;
    LightDrag drag(light, figure, *handle, view, handle->place);
    drag.drag(moved, kNowSeconds, view, handle->place + 30.0 * handle->way, false);
    const double metres = moved.positionWS.y - light.positionWS.y;
    EXPECT_GT(metres, 0.0);
    for (const double seconds : {0.0, kNowSeconds, 3.0}) {
        const glm::dvec3 stepWS =
            scenes::lightAtTime(moved, seconds).positionWS - scenes::lightAtTime(light, seconds).positionWS;
        EXPECT_LT(glm::distance(stepWS, glm::dvec3(0.0, metres, 0.0)), 1e-12) << seconds;
    }
    drag.drag(moved, 3.0, view, handle->place, false);
    EXPECT_LT(glm::distance(moved.positionWS, light.positionWS), kArmRoundingMetres)
        << "the pointer is where it took the arm";
}

TEST(LightDrag, aDirectionGoesWithThePointerAndOverTheRimToTheOtherSide) {
    for (const PictureView& view : dragViews())
        for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
            if (!type.hasDirection) continue;
            SCOPED_TRACE(type.name);
            const scenes::Light light = draggedLight(type.type);
            const LightFigure figure = lightFigure(light, view, 1.0);
            const auto handle = std::ranges::find(figure.handles, true, &LightHandle::turns);
            ASSERT_NE(handle, figure.handles.end());
            const glm::dvec3 armWS = handle->positionWS - figure.middleWS;
            scenes::Light turned = light;
            LightDrag drag(light, figure, *handle, view, handle->place);
            const glm::dvec2 there = handle->place + glm::dvec2(-5.0, -8.0);
            EXPECT_TRUE(drag.drag(turned, 0.0, view, there, false));
            EXPECT_NEAR(glm::length(turned.directionWS), 1.0, 1e-12);
            EXPECT_NEAR(glm::dot(turned.directionWS, turned.alongWS), 0.0, type.isTurned() ? 1e-12 : 1.0);
            const glm::dvec3 tipWS = figure.middleWS + glm::length(armWS) * turned.directionWS;
            EXPECT_LT(glm::distance(view.placeOf(tipWS).value(), there), 1e-6);
            drag.drag(turned, 0.0, view, handle->place, false);
            EXPECT_LT(glm::distance(turned.directionWS, light.directionWS), 1e-9);
            // Dragged far away it is on the rim; dragged back it is on the other side.
            const glm::dvec2 middle = view.placeOf(figure.middleWS).value();
            drag.drag(turned, 0.0, view, middle + 50.0 * (handle->place - middle), false);
            const auto isFar = [&](const glm::dvec3& directionWS) {
                return glm::dot(directionWS, view.sightLineAt(handle->place).directionWS) > 0.0;
            };
            drag.drag(turned, 0.0, view, handle->place, false);
            EXPECT_NE(isFar(turned.directionWS), isFar(light.directionWS));
            const glm::dvec3 otherTipWS = figure.middleWS + glm::length(armWS) * turned.directionWS;
            EXPECT_LT(glm::distance(view.placeOf(otherTipWS).value(), handle->place), 1e-6);
        }
}

TEST(LightDrag, aDirectionAtTheViewerIsTurnedTheWayThePointerGoes) {
    for (const PictureView& view : dragViews())
        for (const double side : {1.0, -1.0}) {
            scenes::Light light = draggedLight(scenes::LightType::Rectangle);
            light.directionWS = side * view.towardsViewerWS(light.positionWS);
            light.alongWS = scenes::usualAlong(light.directionWS);
            const LightFigure figure = lightFigure(light, view, 1.0);
            const auto handle = std::ranges::find(figure.handles, true, &LightHandle::turns);
            ASSERT_NE(handle, figure.handles.end());
            scenes::Light turned = light;
            LightDrag drag(light, figure, *handle, view, handle->place); // beside its true place
            drag.drag(turned, 0.0, view, handle->place, false);
            EXPECT_LT(glm::distance(turned.directionWS, light.directionWS), 1e-9) << "the pointer has not moved";
            const glm::dvec2 way(30.0, -10.0);
            drag.drag(turned, 0.0, view, handle->place + way, false);
            const double armMetres = glm::distance(handle->positionWS, figure.middleWS);
            const glm::dvec2 tip = view.placeOf(light.positionWS + armMetres * turned.directionWS).value();
            EXPECT_LT(glm::distance(tip, handle->truePlace + way), 1e-6);
            EXPECT_GT(glm::dot(turned.directionWS, light.directionWS), 0.0) << "it turned to the other side";
        }
}

TEST(LightDrag, itsWordsNameTheMeasureAndItsUnit) {
    const PictureView view = dragViews()[0];
    scenes::Light light = draggedLight(scenes::LightType::Rectangle);
    light.directionWS = {0.0, -1.0, 0.0};
    light.alongWS = {1.0, 0.0, 0.0};
    const LightFigure figure = lightFigure(light, view, 1.0);
    std::vector<std::string> texts;
    for (const LightHandle& handle : figure.handles)
        texts.push_back(LightDrag(light, figure, handle, view, handle.place).text(light, 0.0));
    EXPECT_EQ(texts, (std::vector<std::string>{"Width 0.8 m", "Width 0.8 m", "Height 0.5 m", "Height 0.5 m",
                                               "Direction 0.00, -1.00, 0.00", "Position x 0.400 m",
                                               "Position y 1.200 m", "Position z -0.300 m"}));
    light = draggedLight(scenes::LightType::Polygon);
    const LightFigure ofPolygon = lightFigure(light, view, 1.0);
    const LightHandle& corner = ofPolygon.handles.at(1);
    EXPECT_EQ(LightDrag(light, ofPolygon, corner, view, corner.place).text(light, 0.0), "Corner 1 at 0.5, -0.5 m");
}

} // namespace
} // namespace tessera::viewer
