#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenes/AreaLight.h"
#include "tests/unit/docs/Tables.h"
#include "tests/unit/viewer/HandleTest.h"
#include "viewer/edit/LightFigure.h"

namespace tessera::viewer {
namespace {

constexpr glm::dvec2 kFigurePicture{1000.0, test::kHeightPixels};

using test::askewLight;

std::vector<PictureView> twoViews() {
    return test::twoViews({1.0, 0.7, 4.0}, {0.1, 0.2, 0.0});
}

TEST(LightFigure, everyTypeHasTheHandlesOfItsShapeItsDirectionAndItsPosition) {
    using Type = scenes::LightType;
    const std::map<Type, std::size_t> ofShape{
        {Type::Rectangle, 4}, {Type::Disk, 4}, {Type::Sphere, 4}, {Type::Tube, 4}, {Type::Polygon, 4}};
    for (const PictureView& view : twoViews())
        for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
            SCOPED_TRACE(type.name);
            const LightFigure figure = lightFigure(askewLight(type.type), view, 1.0);
            const auto turning = std::ranges::count(figure.handles, true, &LightHandle::turns);
            EXPECT_EQ(turning, type.hasDirection ? 1 : 0);
            const auto moving = std::ranges::count(figure.handles, true, &LightHandle::moves);
            EXPECT_EQ(moving, type.hasPosition() ? 3 : 0);
            const std::size_t shaping = figure.handles.size() - std::size_t(turning + moving);
            EXPECT_EQ(shaping, ofShape.contains(type.type) ? ofShape.at(type.type) : 0u);
            EXPECT_EQ(figure.sun.has_value(), !type.hasPosition());
            EXPECT_EQ(figure.outlinesWS.empty(), type.type == Type::Point);
            if (type.hasCorners()) {
                EXPECT_EQ(figure.outlinesWS.at(0).size(), 5u) << "its corners, and the first again";
            }
            // An area light shows all its measures.
            for (const scenes::LightParameter& parameter : type.parameters)
                if (type.isArea) {
                    EXPECT_EQ(std::ranges::count(figure.handles, &parameter, &LightHandle::parameter), 2)
                        << parameter.label;
                }
        }
}

TEST(LightFigure, theHandlesOfEveryTypeAreThoseOfTheDocument) {
    tessera::test::Rows rows;
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        std::vector<std::string> square;
        std::string round, arms;
        for (const LightHandle& handle : lightFigure(askewLight(type.type), twoViews()[0], 1.0).handles) {
            if (handle.turns()) {
                round = "direction";
                continue;
            }
            if (handle.moves()) {
                arms += (arms.empty() ? "" : ", ") + std::string(1, handle.axisName());
                continue;
            }
            std::string label = handle.parameter != nullptr ? handle.parameter->label : "corners";
            label[0] = char(std::tolower(static_cast<unsigned char>(label[0])));
            if (std::ranges::find(square, label) == square.end()) square.push_back(label);
        }
        rows.push_back({fmt::format("`{}`", type.name), fmt::format("{}", fmt::join(square, ", ")), round, arms});
    }
    const std::string table = tessera::test::markdownTable({"light", "square handles", "round handle", "arms"}, rows);
    EXPECT_TRUE(tessera::test::holdsTable(tessera::test::textOf(tessera::test::kRepository / "docs/viewer.md"), table))
        << table;
}

TEST(LightFigure, handlesLieInTheMiddlesOfARectanglesSides) {
    const PictureView view = twoViews()[0];
    const scenes::Light light = askewLight(scenes::LightType::Rectangle);
    const LightFigure figure = lightFigure(light, view, 1.0);
    ASSERT_EQ(figure.outlinesWS.at(0).size(), 5u);
    for (const LightHandle& handle : figure.handles) {
        if (handle.parameter == nullptr) continue;
        const auto isMiddle = [&](std::size_t i) {
            const glm::dvec3 middleWS = 0.5 * (figure.outlinesWS[0][i] + figure.outlinesWS[0][i + 1]);
            return glm::distance(middleWS, handle.positionWS) < 1e-12;
        };
        EXPECT_EQ(int(isMiddle(0)) + int(isMiddle(1)) + int(isMiddle(2)) + int(isMiddle(3)), 1);
        EXPECT_LT(glm::distance(handle.place, view.placeOf(handle.positionWS).value()), 1e-9);
    }
}

TEST(LightFigure, linesOfSightTouchTheOutlineOfASphereAndTheSidesOfATube) {
    for (const PictureView& view : twoViews()) {
        const scenes::Light sphere = askewLight(scenes::LightType::Sphere);
        const LightFigure ofSphere = lightFigure(sphere, view, 1.0);
        for (const glm::dvec3& pointWS : ofSphere.outlinesWS.at(0)) {
            const glm::dvec3 away = view.sightLineAt(view.placeOf(pointWS).value()).directionWS;
            EXPECT_NEAR(glm::length(pointWS), double(sphere.radiusMetres), 1e-12);
            EXPECT_NEAR(glm::dot(pointWS, away), 0.0, 1e-12) << "the normal there is across the line of sight";
        }
        const scenes::Light tube = askewLight(scenes::LightType::Tube);
        const LightFigure figure = lightFigure(tube, view, 1.0);
        int sides = 0;
        for (const std::vector<glm::dvec3>& outlineWS : figure.outlinesWS) {
            if (outlineWS.size() != 2 || glm::length(glm::cross(outlineWS[0], tube.directionWS)) < 1e-9) continue;
            ++sides;
            for (const glm::dvec3& pointWS : outlineWS) {
                const glm::dvec3 normal = pointWS - glm::dot(pointWS, tube.directionWS) * tube.directionWS;
                const glm::dvec3 away = view.sightLineAt(view.placeOf(pointWS).value()).directionWS;
                EXPECT_NEAR(glm::length(normal), double(tube.radiusMetres), 1e-12);
                EXPECT_NEAR(glm::dot(normal, away), 0.0, 1e-12);
            }
        }
        EXPECT_EQ(sides, 2);
    }
}

TEST(LightFigure, theRangeOfALightWithOneIsASphereOrASpotsCone) {
    constexpr double kRangeMetres = 2.0;
    for (const PictureView& view : twoViews())
        for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
            SCOPED_TRACE(type.name);
            scenes::Light light = askewLight(type.type);
            light.rangeMetres = scenes::kInfinity;
            EXPECT_TRUE(lightFigure(light, view, 1.0).rangeWS.empty()) << "it has no end";
            light.rangeMetres = float(kRangeMetres);
            const LightFigure figure = lightFigure(light, view, 1.0);
            EXPECT_EQ(figure.rangeWS.empty(), !type.hasPosition());
            for (const std::vector<glm::dvec3>& outlineWS : figure.rangeWS)
                for (const glm::dvec3& pointWS : outlineWS) { // the light is at the origin
                    const double metres = glm::length(pointWS);
                    EXPECT_TRUE(metres == 0.0 || std::abs(metres - kRangeMetres) < 1e-9) << metres;
                    if (type.type == scenes::LightType::Spot && metres > 0.0) {
                        EXPECT_NEAR(glm::dot(pointWS / metres, light.directionWS), std::cos(light.outerConeRadians),
                                    1e-6);
                    }
                }
        }
    // An eye inside the range gets a circle at the height of the light.
    scenes::Light around = askewLight(scenes::LightType::Point);
    around.rangeMetres = 100.0f;
    const LightFigure figure = lightFigure(around, twoViews()[0], 1.0);
    for (const glm::dvec3& pointWS : figure.rangeWS.at(0)) EXPECT_EQ(pointWS.y, 0.0);
}

TEST(LightFigure, handlesOfASmallLightLieAroundItsMarker) {
    for (const double scale : {1.0, 2.0}) {
        scenes::Light light = askewLight(scenes::LightType::Rectangle);
        light.widthMetres = light.heightMetres = 0.0f;
        const PictureView view = twoViews()[0];
        const LightFigure figure = lightFigure(light, view, scale);
        const glm::dvec2 marker = view.placeOf(light.positionWS).value();
        for (const LightHandle& handle : figure.handles)
            EXPECT_GE(glm::distance(handle.place, marker), 20.0 * scale - 1e-6) << "a marker is taken within 9";
    }
}

TEST(LightFigure, aDirectionTowardsTheViewerOrAwayIsTakenBesideTheMarker) {
    for (const PictureView& view : twoViews())
        for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
            if (!type.hasDirection || !type.hasPosition()) continue;
            for (const double side : {1.0, -1.0}) {
                SCOPED_TRACE(type.name);
                scenes::Light light = askewLight(type.type);
                light.widthMetres = light.heightMetres = light.lengthMetres = light.radiusMetres = 0.01f;
                light.directionWS = side * view.towardsViewerWS(light.positionWS);
                light.alongWS = scenes::usualAlong(light.directionWS);
                const LightFigure figure = lightFigure(light, view, 1.0);
                const glm::dvec2 marker = view.placeOf(light.positionWS).value();
                const auto handle = std::ranges::find(figure.handles, true, &LightHandle::turns);
                ASSERT_NE(handle, figure.handles.end());
                EXPECT_LT(glm::distance(handle->truePlace, marker), 1e-6);
                // A press takes the nearest handle or marker within 9 units.
                EXPECT_GT(glm::distance(handle->place, marker), 18.0);
                for (const LightHandle& other : figure.handles)
                    if (!other.turns()) {
                        EXPECT_GT(glm::distance(handle->place, other.place), 18.0);
                    }
            }
        }
}

TEST(LightFigure, theArmOfADirectionDoesNotReachTheViewerInSmallPictures) {
    for (const double sizeUnits : {60.0, 200.0, 1000.0}) {
        const PictureView view(test::perspective({0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 120.0),
                               {sizeUnits, sizeUnits});
        scenes::Light light = askewLight(scenes::LightType::Spot);
        light.directionWS = {0.0, 0.0, 1.0}; // towards the viewer
        for (const double scale : {1.0, 2.0}) {
            const LightFigure figure = lightFigure(light, view, scale);
            const double armMetres = glm::distance(figure.outlinesWS.back().front(), figure.outlinesWS.back().back());
            EXPECT_GT(armMetres, 0.0);
            EXPECT_LT(armMetres, 2.5) << "of 3 m to the viewer: " << sizeUnits << " x" << scale;
        }
    }
}

TEST(LightFigure, whatCannotBeDraggedHasNoHandle) {
    scenes::Light light = askewLight(scenes::LightType::Rectangle);
    light.directionWS = {0.0, -1.0, 0.0};
    light.alongWS = {1.0, 0.0, 0.0};
    // Viewed along its width.
    const PictureView along({test::perspective({5.0, 0.0, 0.0}, {0.0, 0.0, 0.0})}, kFigurePicture);
    for (const LightHandle& handle : lightFigure(light, along, 1.0).handles)
        EXPECT_TRUE(handle.parameter == nullptr || handle.parameter->member == &scenes::Light::heightMetres);
    // No handle is offered outside the image.
    scenes::Light wide = light;
    wide.directionWS = twoViews()[0].towardsViewerWS(wide.positionWS);
    wide.alongWS = twoViews()[0].rightWS();
    wide.widthMetres = wide.heightMetres = 100.0f;
    for (const LightHandle& handle : lightFigure(wide, twoViews()[0], 1.0).handles)
        EXPECT_TRUE(handle.turns() || handle.moves());
    const PictureView away({test::perspective({5.0, 0.0, 0.0}, {9.0, 0.0, 0.0})}, kFigurePicture);
    EXPECT_TRUE(lightFigure(light, away, 1.0).handles.empty());
    // From inside, a sphere's outline is not visible.
    scenes::Light around = askewLight(scenes::LightType::Sphere);
    around.radiusMetres = 6.0f;
    const LightFigure inside = lightFigure(around, along, 1.0);
    for (const LightHandle& handle : inside.handles) EXPECT_TRUE(handle.moves());
    EXPECT_TRUE(inside.outlinesWS.empty());
}

TEST(LightFigure, noHandleLiesOnAnotherWhateverTheShapesSizeAndTurn) {
    // Radii and sides from below a pixel to more than the length of a direction's arm, and directions all around.
    for (const PictureView& view : twoViews())
        for (const scenes::LightTypeInfo& type : scenes::lightTypes())
            for (double metres = 0.001; metres < 1.0; metres *= 1.13)
                for (int turn = 0; turn < 12; ++turn) {
                    SCOPED_TRACE(fmt::format("{} of {} m, turn {}", type.name, metres, turn));
                    const double height = turn / 6.0 - 0.9, angle = 2.0 * turn;
                    scenes::Light light = askewLight(type.type);
                    light.directionWS = glm::normalize(glm::dvec3(std::cos(angle), height, std::sin(angle)));
                    if (turn % 4 == 0) light.directionWS = -view.towardsViewerWS(light.positionWS);
                    light.alongWS = scenes::usualAlong(light.directionWS);
                    light.radiusMetres = light.lengthMetres = light.widthMetres = float(metres);
                    light.heightMetres = float(0.7 * metres);
                    for (std::size_t i = 0; i < light.corners.count; ++i) light.corners.metres[i] *= float(metres);
                    const std::vector<LightHandle> handles = lightFigure(light, view, 1.0).handles;
                    for (std::size_t i = 0; i < handles.size(); ++i)
                        for (std::size_t other = 0; other < i; ++other) // a press takes handles within 9
                            ASSERT_GT(glm::distance(handles[i].place, handles[other].place), 18.0)
                                << handles[i].number << " and " << handles[other].number;
                }
}

TEST(LightFigure, aPolygonHasAHandleAtEachCornerUnlessItIsSeenFromItsEdge) {
    scenes::Light light = askewLight(scenes::LightType::Polygon);
    ASSERT_TRUE(light.corners.add({-0.7f, 0.1f}));
    for (const PictureView& view : twoViews()) {
        const LightFigure figure = lightFigure(light, view, 1.0);
        const auto outlineWS = figure.outlinesWS.at(0);
        ASSERT_EQ(figure.handles.size(), 9u);
        for (std::size_t i = 0; i < 5; ++i) {
            EXPECT_EQ(figure.handles[i].corner, int(i));
            EXPECT_EQ(figure.handles[i].positionWS, outlineWS[i]);
            EXPECT_EQ(pointerShapeOf(figure.handles[i]), PointerShape::AnyWay);
        }
        EXPECT_TRUE(figure.handles[5].turns());
    }
    light.directionWS = {0.0, -1.0, 0.0};
    light.alongWS = {1.0, 0.0, 0.0};
    const PictureView along({test::perspective({5.0, 0.0, 0.0}, {0.0, 0.0, 0.0})}, kFigurePicture);
    for (const LightHandle& handle : lightFigure(light, along, 1.0).handles)
        EXPECT_TRUE(handle.turns() || handle.moves());
}

/// Returns the arm along an axis; null without one.
const LightHandle* armOf(const LightFigure& figure, int axis) {
    const auto found = std::ranges::find(figure.handles, axis, &LightHandle::arm);
    return found == figure.handles.end() ? nullptr : &*found;
}

TEST(LightFigure, armsAreAsLongWhateverTheDistance) {
    const scenes::Light light = askewLight(scenes::LightType::Point);
    for (const double metres : {0.5, 3.0, 200.0})
        for (const double scale : {1.0, 2.0})
            for (const PictureView& view : test::twoViews({0.0, 0.0, metres}, {0.0, 0.0, 0.0})) {
                SCOPED_TRACE(fmt::format("{} m away, scale {}", metres, scale));
                const LightFigure figure = lightFigure(light, view, scale);
                ASSERT_EQ(figure.handles.size(), 2u) << "z points at the eye";
                for (const LightHandle& handle : figure.handles) {
                    const glm::dvec2 way = handle.arm == 0 ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0, -1.0);
                    const glm::dvec2 expected = 0.5 * kFigurePicture + 100.0 * scale * way;
                    EXPECT_LT(glm::distance(handle.place, expected), 1e-6) << handle.arm; // rounding, in pixels of 1000
                    EXPECT_LT(glm::distance(handle.way, way), 1e-6) << handle.arm;
                }
            }
    // In a small image, arms take a fifth of its shorter side.
    const PictureView small(test::perspective({0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}), {400.0, 200.0});
    const LightFigure figure = lightFigure(light, small, 1.0);
    ASSERT_NE(armOf(figure, 0), nullptr);
    EXPECT_LT(glm::distance(armOf(figure, 0)->place, glm::dvec2(240.0, 100.0)), 1e-6);
}

TEST(LightFigure, anArmAtTheEyeOrAwayFromItIsNotOffered) {
    const scenes::Light light = askewLight(scenes::LightType::Point);
    for (const double degrees : {0.0, 11.9, 12.1, 90.0, 167.9, 168.1, 180.0})
        for (int axis = 0; axis < 3; ++axis) {
            SCOPED_TRACE(fmt::format("axis {}, {} degrees from the line of sight", axis, degrees));
            // Deviates along the diagonal of the other two axes, so that neither points at the eye.
            glm::dvec3 axisWS(0.0), asideWS(std::sqrt(0.5));
            axisWS[axis] = 1.0;
            asideWS[axis] = 0.0;
            const double angle = glm::radians(degrees);
            const glm::dvec3 eyeWS = 4.0 * (std::cos(angle) * axisWS + std::sin(angle) * asideWS);
            const glm::dvec3 upWS = axis == 1 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
            const PictureView view(test::perspective(eyeWS, {0.0, 0.0, 0.0}, upWS), kFigurePicture);
            const LightFigure figure = lightFigure(light, view, 1.0);
            const bool isOffered = degrees > 12.0 && degrees < 168.0;
            EXPECT_EQ(armOf(figure, axis) != nullptr, isOffered);
            EXPECT_EQ(figure.handles.size(), isOffered ? 3u : 2u);
        }
}

TEST(LightFigure, anArmGivesWayToOtherHandlesAndIsNotOfferedWhereThePictureHasNoRoom) {
    const PictureView view = test::twoViews({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0})[1];
    const double metresPerUnit = view.metresPerUnit({0.0, 0.0, 0.0}).value();
    scenes::Light light = askewLight(scenes::LightType::Rectangle);
    light.directionWS = {0.0, 0.0, 1.0};
    light.alongWS = {1.0, 0.0, 0.0};
    light.widthMetres = float(200.0 * metresPerUnit); // one of its sides is at the arm's end
    light.heightMetres = float(100.0 * metresPerUnit);
    const LightFigure inTheMiddle = lightFigure(light, view, 1.0);
    ASSERT_NE(armOf(inTheMiddle, 0), nullptr);
    EXPECT_LT(glm::distance(inTheMiddle.handles.at(0).place, glm::dvec2(600.0, 500.0)), 1e-3) << "the side's stays";
    const glm::dvec2 place = armOf(inTheMiddle, 0)->place;
    EXPECT_GE(place.x, 618.0) << "a press takes what is nearest within 9";
    EXPECT_LE(place.x, 630.0);
    EXPECT_EQ(handleAt(inTheMiddle.handles, place, 9.0), std::size_t(armOf(inTheMiddle, 0) - &inTheMiddle.handles[0]));
    light.positionWS.x = 390.0 * metresPerUnit; // its side is 10 from the image's side
    const LightFigure atTheRight = lightFigure(light, view, 1.0);
    EXPECT_EQ(armOf(atTheRight, 0), nullptr);
    EXPECT_NE(armOf(atTheRight, 1), nullptr);
    EXPECT_LT(glm::distance(atTheRight.handles.at(0).place, glm::dvec2(990.0, 500.0)), 1e-3);
}

TEST(LightFigure, armsAloneSayWhatADragDoes) {
    std::string hints;
    for (const LightHandle& handle : lightFigure(askewLight(scenes::LightType::Disk), twoViews()[0], 1.0).handles) {
        EXPECT_EQ(hintOf(handle).empty(), !handle.moves());
        hints += hintOf(handle) + (handle.moves() ? "\n" : "");
    }
    EXPECT_EQ(hints, "Drag to move along x\nDrag to move along y\nDrag to move along z\n");
}

TEST(LightFigure, theNearestHandleWithinReachIsTaken) {
    std::vector<LightHandle> handles(3);
    handles[0].place = {10.0, 10.0};
    handles[1].place = {16.0, 10.0};
    handles[2].place = {40.0, 10.0};
    EXPECT_EQ(handleAt(handles, {12.0, 10.0}, 9.0), 0u);
    EXPECT_EQ(handleAt(handles, {14.0, 10.0}, 9.0), 1u);
    EXPECT_FALSE(handleAt(handles, {28.0, 10.0}, 9.0));
}

TEST(LightFigure, thePointersShapeIsTheWayOfTheHandle) {
    LightHandle handle;
    handle.parameter = scenes::sizeParameter(scenes::infoOf(scenes::LightType::Disk));
    const auto shapeOf = [&](double x, double y) {
        handle.way = glm::normalize(glm::dvec2(x, y));
        return pointerShapeOf(handle);
    };
    for (const double sign : {1.0, -1.0}) {
        EXPECT_EQ(shapeOf(sign, 0.3 * sign), PointerShape::LeftRight);
        EXPECT_EQ(shapeOf(0.3 * sign, -sign), PointerShape::UpDown);
        EXPECT_EQ(shapeOf(sign, sign), PointerShape::Falling);
        EXPECT_EQ(shapeOf(sign, -sign), PointerShape::Rising);
    }
    handle.parameter = nullptr;
    EXPECT_EQ(pointerShapeOf(handle), PointerShape::AnyWay);
    handle.arm = 2;
    EXPECT_EQ(shapeOf(1.0, 0.0), PointerShape::LeftRight);
}

} // namespace
} // namespace tessera::viewer
