#include "validation/bench/KeyValues.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/Settings.h"

namespace tessera::validation {

const std::string* valueText(const std::vector<KeyValue>& values, std::string_view key) {
    const auto value = std::ranges::find(values, key, &KeyValue::key);
    return value == values.end() ? nullptr : &value->text;
}

std::string changedText(const std::vector<KeyValue>& values, std::string_view key, std::string_view format) {
    const std::string* const value = valueText(values, key);
    if (value == nullptr || *value == engine::settingOf(key).text({})) return {};
    return ", " + fmt::format(fmt::runtime(format), *value);
}

} // namespace tessera::validation
