#include "validation/stress/Stress.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/unit/validation/Samples.h"
#include "validation/reference/Reflectance.h"
#include "validation/stress/StressDirections.h"
#include "validation/stress/StressModels.h"
#include "validation/stress/StressRecord.h"

namespace tessera::validation {
namespace {

using Json = nlohmann::ordered_json;

StressResult goodResult() {
    StressResult result;
    result.name = "group/case";
    result.tolerance = 1e-3;
    result.figures.samples = 10;
    result.figures.worstRel = 1e-4;
    result.figures.where = "somewhere";
    return result;
}

TEST(StressCases, everyCaseHasAnUnusedNameInAGroupAToleranceAndItsReason) {
    std::set<std::string> names;
    for (const StressCase& row : stressCases()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_NE(row.name.find('/'), std::string::npos) << row.name;
        EXPECT_FALSE(row.holds.empty()) << row.name;
        EXPECT_GT(row.tolerance, 0.0) << row.name;
        EXPECT_GT(row.reason.size(), 20u) << row.name;
        EXPECT_NE(bool(row.measure), bool(row.pictures)) << row.name << " must be one kind of case";
    }
    EXPECT_GE(names.size(), 30u);
}

TEST(StressCases, everyPictureIsAValidSceneInBothForms) {
    for (const StressCase& row : stressCases()) {
        if (!row.pictures) continue;
        const std::vector<StressPicture> quick = row.pictures(StressEffort::Quick);
        EXPECT_FALSE(quick.empty()) << row.name;
        for (std::size_t i = 0; i < quick.size(); ++i) {
            EXPECT_NO_THROW(scenes::checkScene(quick[i].scene)) << row.name << ": " << quick[i].what;
            if (quick[i].sameAs) {
                EXPECT_LT(*quick[i].sameAs, i) << row.name;
            }
        }
    }
}

TEST(StressModels, everyLitModelOfTheReferenceHasExactlyOneRow) {
    for (const reference::Model& model : reference::modelTable()) {
        const auto rows = std::count_if(stressModels().begin(), stressModels().end(),
                                        [&](const StressModel& candidate) { return candidate.model == model.model; });
        EXPECT_EQ(rows, scenes::infoOf(model.model).isLit ? 1 : 0) << "model " << int(model.model);
    }
}

TEST(StressModels, randomMaterialsAreOnesThatScenesMayHave) {
    StressRandom random(1);
    for (const StressModel& model : stressModels()) {
        scenes::Scene scene;
        scene.name = scenes::infoOf(model.model).name;
        for (int i = 0; i < 200; ++i) {
            scenes::Material material;
            material.model = model.model;
            model.randomise(material, random);
            EXPECT_GT(model.sharpness(material), 0.0);
            scene.materials.push_back(material);
        }
        EXPECT_NO_THROW(scenes::checkScene(scene));
    }
}

TEST(StressDirections, everyDirectionIsUnitAndTheFirstIsRandom) {
    StressRandom random(2);
    EXPECT_STREQ(stressDirections().front().name, "random");
    for (const StressDirection& direction : stressDirections()) {
        for (int i = 0; i < 1000; ++i) {
            const StressView view = stressView(direction, random.logarithmic(1e-3, 1.0), random);
            for (const glm::vec3& vector : {view.normal, view.tangent, view.toLight, view.toViewer})
                EXPECT_NEAR(glm::length(glm::dvec3(vector)), 1.0, 2e-7) << direction.name; // fp32 rounds three times
        }
    }
}

TEST(StressFigures, aSampleCountsOnceAKind) {
    StressFigures figures;
    const float nan = std::nanf(""), inf = INFINITY;
    for (const std::vector<float>& sample :
         {std::vector<float>{nan, nan, 1.0f}, {-1.0f, inf, inf}, {-inf, 0.0f, -0.0f}, {1.0f, 2.0f, 3.0f}})
        figures.count(sample);
    EXPECT_EQ(figures.samples, 4u);
    EXPECT_EQ(figures.nan, 1u);
    EXPECT_EQ(figures.infinite, 2u);
    EXPECT_EQ(figures.negative, 2u);
}

TEST(StressFigures, theWorstErrorReportsWhereItIsAndNaNIsTheWorst) {
    StressFigures figures;
    figures.error(0.5, [] { return "a"; });
    figures.error(0.25, [] { return "b"; });
    EXPECT_EQ(figures.where, "a");
    figures.error(std::nan(""), [] { return "c"; });
    EXPECT_EQ(figures.where, "c");
    EXPECT_TRUE(std::isinf(figures.worstRel));
}

TEST(StressFigures, aBlackPictureNeverHolds) {
    StressResult result = goodResult();
    result.figures.addPicture(errorFigures(greyPicture(4, 4, 0.0f), greyPicture(4, 4, 0.0f)), "night");
    EXPECT_FALSE(result.ok());
    EXPECT_THAT(result.missed().front(), testing::HasSubstr("night"));
}

TEST(StressResult, holdsExactlyWhenNothingIsBadAndItsFigureIsWithinTheTolerance) {
    EXPECT_TRUE(goodResult().ok());
    const auto missedBy = [](auto change) {
        StressResult result = goodResult();
        change(result);
        return result.missed();
    };
    EXPECT_THAT(missedBy([](StressResult& r) { r.figures.nan = 1; }), testing::ElementsAre("1 of 10 samples are NaN"));
    EXPECT_EQ(missedBy([](StressResult& r) { r.figures.infinite = 1; }).size(), 1u);
    EXPECT_EQ(missedBy([](StressResult& r) { r.figures.negative = 1; }).size(), 1u);
    EXPECT_EQ(missedBy([](StressResult& r) { r.figures.samples = 0; }).size(), 1u);
    EXPECT_THAT(missedBy([](StressResult& r) { r.figures.worstRel = 0.5; }),
                testing::ElementsAre("the worst relative error is 0.5, at most 0.001 is required; at somewhere"));
    // A case may bound the other figure instead.
    EXPECT_TRUE(missedBy([](StressResult& r) {
                    r.bound = StressBound::RelMse;
                    r.figures.worstRel = 0.5;
                }).empty());
}

TEST(StressNames, aGroupIsAllItsCasesAndAnUnknownNameNamesTheNearest) {
    EXPECT_EQ(stressCasesNamed("scene/far").size(), 1u);
    EXPECT_EQ(stressCasesNamed("directions").size(), stressDirections().size());
    EXPECT_THAT(test::errorText<InputError>([] { stressCasesNamed("scene/fax"); }), testing::HasSubstr("scene/far"));
    EXPECT_THROW(stressCasesNamed("scen"), InputError);
}

TEST(StressRecord, jsonHasTheAgreedFieldsAndAReasonForEachNull) {
    StressRecord record{"llvmpipe", StressEffort::Quick, {goodResult(), goodResult()}};
    record.results[1].technique = engine::Technique::Deferred;
    record.results[1].figures.worstRel = INFINITY;
    const Json json = Json::parse(stressJson(record));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["renderer"], "llvmpipe");
    ASSERT_EQ(json["cases"].size(), 2u);
    for (const Json& row : json["cases"]) {
        for (const char* field :
             {"name", "technique", "samples", "nan", "inf", "negative", "worstRel", "tolerance", "ok"})
            EXPECT_TRUE(row.contains(field)) << field;
        for (const auto& [name, value] : row.items()) {
            if (value.is_null()) {
                EXPECT_FALSE(row["why"].value(name, "").empty()) << name;
            }
        }
    }
    EXPECT_EQ(json["cases"][0]["ok"], true);
    EXPECT_TRUE(json["cases"][0]["technique"].is_null());
    EXPECT_EQ(json["cases"][1]["technique"], "deferred");
    EXPECT_EQ(json["cases"][1]["ok"], false);
    EXPECT_EQ(json["ok"], false);
}

TEST(StressRecord, theTableSaysWhatWasMissedAndAnEmptyRecordNeverHolds) {
    StressRecord record{"llvmpipe", StressEffort::Full, {goodResult()}};
    EXPECT_THAT(stressTable(record), testing::HasSubstr("all 1 hold over 10 samples\n"));
    record.results[0].figures.negative = 3;
    EXPECT_THAT(stressTable(record),
                testing::HasSubstr("missed: group/case: 3 of 10 samples are negative\n1 of 1 missed"));
    record.results.clear();
    EXPECT_FALSE(record.ok());
    for (const StressCase& row : stressCases()) EXPECT_THAT(stressList(), testing::HasSubstr(row.name + " "));
}

} // namespace
} // namespace tessera::validation
