#include <nlohmann/json.hpp>

#include "renderer/graph/Plan.h"

namespace tessera::graph {
namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
Json valueOrNull(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json textOrNull(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

/// Converts a list to a JSON array.
template <typename Items, typename ToJson>
Json listOf(const Items& items, ToJson&& toJson) {
    Json list = Json::array();
    for (const auto& item : items) list.push_back(toJson(item));
    return list;
}

} // namespace

std::string planJson(const Plan& plan) {
    Json json;
    json["schema"] = kPlanSchema;
    json["scene"] = plan.scene;
    json["technique"] = plan.technique;
    json["passes"] = listOf(plan.passes, [](const Plan::Pass& pass) {
        return Json{{"name", pass.name},
                    {"reads", pass.reads},
                    {"writes", pass.writes},
                    {"ms", valueOrNull(pass.ms)},
                    {"barrier", textOrNull(pass.barrier)}};
    });
    json["left_out"] = listOf(plan.leftOut, [](const Plan::LeftOut& item) {
        return Json{{"what", item.what}, {"why", item.why}, {"bytes", item.bytes}, {"ms", valueOrNull(item.ms)}};
    });
    json["choices"] = listOf(plan.choices, [](const Plan::Choice& choice) {
        return Json{{"what", choice.what}, {"chosen", choice.chosen}, {"why", choice.why}};
    });
    json["counters"] = Json::object();
    for (const auto& [name, value] : plan.counters) json["counters"][name] = value;
    json["resources"] = listOf(plan.resources, [](const Plan::Resource& resource) {
        return Json{
            {"name", resource.name},        {"format", resource.format},   {"width", resource.width},
            {"height", resource.height},    {"samples", resource.samples}, {"bytes", valueOrNull(resource.bytes)},
            {"first", resource.first},      {"last", resource.last},       {"aliasOf", textOrNull(resource.aliasOf)},
            {"imported", resource.imported}};
    });
    json["bytes"] = plan.bytes;
    json["bytesWithoutAliasing"] = plan.bytesWithoutAliasing;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace tessera::graph
