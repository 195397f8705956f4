#include "scenes/import/GltfReader.h"

#include <algorithm>
#include <cmath>

#include "base/Error.h"

namespace tessera::scenes::gltf {

std::string Place::pointer() const {
    if (above_ == nullptr) return {};
    return above_->pointer() + (path_.data() != nullptr ? fmt::format("/{}", path_) : fmt::format("/{}", index_));
}

std::string Place::text() const {
    return above_ == nullptr ? "/" : pointer();
}

void Source::fail(const Place& place, std::string_view what) const {
    throw InputError(fmt::format("{}: {}: {}", file, place.text(), what));
}

void Source::charge(std::uint64_t bytes, const Place& place, std::size_t count) const {
    ledger.charge(bytes, [&] { return fmt::format("{}: {}, {} elements", file, place.text(), count); });
}

// ---- Value ---------------------------------------------------------------------------------------------------------

void Value::requireType(bool isGood, std::string_view type) const {
    if (!isGood) fail(fmt::format("must be {}, but is {}", type, json_.type_name()));
}

void Value::read(std::string& text) const {
    requireType(json_.is_string(), "a string");
    text = std::move(json_.get_ref<std::string&>());
}

void Value::read(bool& flag) const {
    requireType(json_.is_boolean(), "true or false");
    flag = json_.get<bool>();
}

void Value::read(double& number, Range range) const {
    number = this->number(range);
}

void Value::read(float& number, Range range) const {
    number = static_cast<float>(this->number(range));
}

void Value::read(int& index, IndexOf elements) const {
    const std::int64_t number = integer({0.0, kMaxInt});
    const nlohmann::json* array = &source_.document;
    for (std::string_view rest = elements.array; !rest.empty();) {
        const std::string_view key = rest.substr(0, rest.find('/'));
        rest.remove_prefix(std::min(key.size() + 1, rest.size()));
        const auto member = array->is_object() ? array->find(key) : array->end();
        if (!array->is_object() || member == array->end())
            fail(fmt::format("points at /{}/{}, but the document has no {}", elements.array, number, key));
        array = &*member;
    }
    if (!array->is_array())
        source_.fail(Place(Place(), elements.array), fmt::format("must be an array, but is {}", array->type_name()));
    if (static_cast<std::size_t>(number) >= array->size())
        fail(array->empty()
                 ? fmt::format("points at /{}/{}, but /{} is empty", elements.array, number, elements.array)
                 : fmt::format("points at /{}/{}, but there are only {}", elements.array, number, array->size()));
    index = static_cast<int>(number);
}

void Value::read(glm::dmat4& matrix) const {
    std::array<double, 16> numbers;
    readNumbers(numbers, {});
    for (glm::length_t i = 0; i < 16; ++i) matrix[i / 4][i % 4] = numbers[std::size_t(i)];
}

void Value::readNumbers(std::span<double> numbers, Range range) const {
    requireType(json_.is_array(), "an array of numbers");
    if (json_.size() != numbers.size())
        fail(fmt::format("must hold {} numbers, but holds {}", numbers.size(), json_.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = Value(source_, json_[i], Place(place_, i)).number(range);
}

double Value::number(Range range) const {
    requireType(json_.is_number(), "a number");
    const double number = json_.get<double>();
    if (!(std::abs(number) <= std::numeric_limits<float>::max()))
        fail(fmt::format("is {}, which no 32-bit number can hold", json_.dump()));
    requireRange(number, range);
    return number;
}

/// Integers written with a decimal point (24.0) are integers.
std::int64_t Value::integer(Range range) const {
    requireType(json_.is_number(), "an integer");
    const double number = json_.get<double>();
    if (!std::isfinite(number) || number != std::floor(number))
        fail(fmt::format("must be an integer, but is {}", json_.dump()));
    if (std::abs(number) > kMaxInteger)
        fail(fmt::format("is {}, farther from 0 than {}", json_.dump(), std::int64_t(kMaxInteger)));
    requireRange(number, range);
    return static_cast<std::int64_t>(number);
}

void Value::requireRange(double number, Range range) const {
    if (number < range.least) fail(fmt::format("is {}; it must be at least {}", number, range.least));
    if (number > range.most) fail(fmt::format("is {}; it must be at most {}", number, range.most));
}

bool Value::isChosen(std::string_view text) const {
    requireType(json_.is_string(), "a string");
    return json_.get_ref<const std::string&>() == text;
}

bool Value::isChosen(int integer) const {
    return this->integer({}) == integer;
}

void Value::failChoice(std::string_view valid) const {
    const bool isText = json_.is_string();
    fail(isText ? fmt::format("is '{}'; valid are {}", json_.get_ref<const std::string&>(), valid)
                : fmt::format("is {}; valid are {}", integer({}), valid));
}

// ---- Object --------------------------------------------------------------------------------------------------------

Object::Object(const Source& source, nlohmann::json& json, Place place) : source_(source), json_(json), place_(place) {
    if (!json_.is_object()) source_.fail(place_, fmt::format("must be an object, but is {}", json_.type_name()));
}

void Object::failMissing(std::string_view key) const {
    source_.fail(place_, fmt::format("the required property '{}' is missing", key));
}

void Object::fail(std::string_view key, std::string_view what) const {
    source_.fail(Place(place_, key), what);
}

std::optional<Value> Object::find(std::string_view path, bool isRequired) const {
    nlohmann::json* value = &json_;
    for (std::size_t begin = 0;;) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string_view key = path.substr(begin, end - begin);
        const Place above = begin == 0 ? place_ : Place(place_, path.substr(0, begin - 1));
        const Object object(source_, *value, above);
        const auto found = value->find(key);
        const bool isLast = end == path.size();
        if (found == value->end()) {
            if (isRequired && isLast) object.failMissing(key);
            return std::nullopt;
        }
        value = &*found;
        if (isLast) return Value(source_, *value, Place(place_, path));
        begin = end + 1;
    }
}

} // namespace tessera::scenes::gltf
