#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/ranges.h>

#include "scenes/import/GltfSchema.h"

namespace tessera::scenes::gltf {
namespace {

/// A position in a document, linked to its parent. The text is built only for messages: nearly all values are valid.
class Place {
public:
    Place() = default; ///< the document
    Place(const Place& above, std::string_view path) : above_(&above), path_(path) {}
    Place(const Place& above, std::size_t index) : above_(&above), index_(index) {}

    std::string text() const { return above_ == nullptr ? "/" : pointer(); } ///< a JSON pointer, "/" for the document

private:
    std::string pointer() const {
        if (above_ == nullptr) return {};
        return above_->pointer() + (path_.data() != nullptr ? fmt::format("/{}", path_) : fmt::format("/{}", index_));
    }

    const Place* above_ = nullptr;
    std::string_view path_; ///< no data: an array element
    std::size_t index_ = 0;
};

constexpr std::string_view kLeftOut = "it is left out";
constexpr std::string_view kClamped = "the nearest bound is taken";

/// Checks the parts that the scene uses: an array element is checked once a used index refers to it.
class Checker {
public:
    Checker(Json& document, const std::string& file, LoadLedger& ledger, Repairs& repairs)
        : document_(document), file_(file), ledger_(ledger), repairs_(repairs) {
        for (const std::string_view array : schema().countedArrays())
            if (const auto [entry, isNew] = arrays_.try_emplace(array); isNew) find(array, entry->second);
    }

    Json check() {
        Json checked = object(document_, schema().document(), Place());
        if (const auto scenes = arrays_.find("scenes"); !scenes->second.states.empty())
            useIfGood(scenes->second, checked.value("scene", std::size_t{0}));
        else
            useAll("nodes");
        useAll("extensions/KHR_materials_variants/variants"); // referred to by name
        while (!waiting_.empty()) {
            const auto [array, index] = waiting_.back();
            waiting_.pop_back();
            array->checked[index] = object((*array->source)[index], *array->object, Place(array->place, index));
        }
        for (auto& [path, array] : arrays_) {
            if (array.source == nullptr) continue;
            Json* to = &checked;
            for (const std::string_view key : split(path, "/")) to = &(*to)[key];
            *to = std::move(array.checked);
        }
        return checked;
    }

private:
    enum class State : char { New, Used, Flawed };

    /// An array of the document. Without `source`, `missing` or `type` is set.
    struct Array {
        Json* source = nullptr;
        const Struct* object = nullptr;
        Place place;
        Json checked = Json::array();
        std::vector<State> states;
        std::map<std::size_t, std::string> flaws;
        std::string_view missing; ///< the missing key
        std::string type;         ///< type of the value that is not an array
    };

    void find(std::string_view path, Array& array) {
        array.place = Place(root_, path);
        Json* value = &document_;
        for (const std::string_view key : split(path, "/")) {
            const auto member = value->is_object() ? value->find(key) : value->end();
            if (!value->is_object() || member == value->end()) {
                array.missing = key;
                return;
            }
            value = &*member;
        }
        array.type = value->is_array() ? "" : value->type_name();
        if (!value->is_array()) return;
        const Property& property = *std::ranges::find(schema().document().properties, path, &Property::path);
        array.source = value;
        array.object = property.type.object;
        constexpr std::uint64_t kMostMembers = 3; // members of a stand-in
        charge(value->size() * (array.object->bytes + sizeof(State) + kMostMembers * 2 * kHeapBlockBytes), array.place,
               value->size());
        array.states.resize(value->size());
        array.checked.get_ref<Json::array_t&>().assign(value->size(), array.object->standIn);
    }

    void useIfGood(Array& array, std::size_t index) {
        repairs_.attempt(kLeftOut, [&] { use(array, index); });
    }

    void useAll(std::string_view path) {
        Array& array = arrays_.find(path)->second;
        for (std::size_t i = 0; i < array.states.size(); ++i) useIfGood(array, i);
    }

    /// Checks an element; throws InputError if flawed. Elements that cannot be flawed are queued, since nodes nest.
    void use(Array& array, std::size_t index) {
        State& state = array.states[index];
        if (state == State::Flawed) throw InputError(array.flaws.at(index));
        if (state == State::Used) return;
        state = State::Used;
        try {
            const Place place(array.place, index);
            Json& element = (*array.source)[index];
            require(element.is_object(), "an object", element, place);
            if (array.object->canBeFlawed())
                array.checked[index] = object(element, *array.object, place);
            else
                waiting_.emplace_back(&array, index);
        } catch (const MemoryRefused&) {
            throw;
        } catch (const InputError& error) {
            state = State::Flawed;
            const std::string& flaw = array.flaws.emplace(index, error.what()).first->second;
            charge(kMemberBytes + flaw.size(), array.place, 1);
            throw;
        }
    }

    Json object(Json& value, const Struct& object, const Place& place) {
        require(value.is_object(), "an object", value, place);
        Json checked = Json::object();
        const bool hasExtensions = value.contains("extensions");
        for (const Property& property : object.properties) {
            if (property.isExtension && !hasExtensions) continue;
            if (&object == &schema().document() && arrays_.contains(property.path)) continue;
            const auto take = [&] {
                Json* const found = find(value, property, checked, place);
                if (found == nullptr) return;
                const bool isValue = object.isValue || property.isExtension;
                if (isValue) charge(kMemberBytes * property.keys.size(), place, 1);
                Json taken =
                    arrays(*found, property.type, property.type.arrays.size(), isValue, Place(place, property.path));
                Json* to = &checked;
                for (const std::string_view key : property.keys) to = &(*to)[key];
                *to = std::move(taken);
            };
            if (property.isWhole)
                take();
            else
                repairs_.attempt(kLeftOut, take);
        }
        return checked;
    }

    /// Finds the value of a property; `checked` holds the properties before it.
    Json* find(Json& object, const Property& property, const Json& checked, const Place& place) const {
        Json* value = &object;
        for (std::size_t i = 0; i < property.keys.size(); ++i) {
            const std::string_view key = property.keys[i];
            const auto above = [&] {
                return std::string_view(property.path.data(),
                                        i == 0 ? 0 : std::size_t(key.data() - property.path.data()) - 1);
            };
            if (i > 0) require(value->is_object(), "an object", *value, Place(place, above()));
            const auto found = value->find(key);
            if (found != value->end()) {
                value = &*found;
                continue;
            }
            if (i + 1 == property.keys.size() && isRequired(checked, property))
                fail(i == 0 ? place : Place(place, above()), "the required property '{}' is missing", key);
            return nullptr;
        }
        return value;
    }

    static bool isRequired(const Json& checked, const Property& property) {
        if (property.conditionKey.empty()) return property.isRequired;
        const auto found = checked.find(property.conditionKey);
        return found != checked.end() && found->get_ref<const std::string&>() == property.condition;
    }

    Json arrays(Json& value, const Type& type, std::size_t depth, bool isValue, const Place& place) {
        if (depth == 0) return single(value, type, isValue, place);
        const std::string_view size = type.arrays[depth - 1];
        const std::uint64_t numberBytes = isValue ? sizeof(tiny::Value) : kGrowth * sizeof(double);
        const std::uint64_t blockBytes = isValue ? sizeof(tiny::Value) : kGrowth * kHeapBlockBytes;
        const std::uint64_t bytes = type.object != nullptr                 ? type.object->bytes
                                    : depth > 1 || type.kind == Kind::Text ? blockBytes
                                                                           : numberBytes;
        if (size == "{}") {
            require(value.is_object(), "an object", value, place);
            charge(value.size() * (isValue ? kMemberBytes : 3 * kHeapBlockBytes), place, value.size());
            for (auto element = value.begin(); element != value.end();) {
                const bool isGood = repairs_.attempt(kLeftOut, [&] {
                    *element = arrays(*element, type, depth - 1, isValue, Place(place, element.key()));
                });
                element = isGood ? std::next(element) : value.erase(element);
            }
            return std::move(value);
        }
        const bool isVector = !size.empty() && size != "~" && size != "?";
        require(value.is_array(), isVector ? "an array of numbers" : "an array", value, place);
        if (isVector) takeLength(value, size, type, place);
        charge(value.size() * bytes + kHeapBlockBytes, place, value.size());
        auto& elements = value.get_ref<Json::array_t&>();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const auto take = [&] { elements[kept] = arrays(elements[i], type, depth - 1, isValue, Place(place, i)); };
            if (size != "~" && size != "?") {
                take();
            } else if (!repairs_.attempt(kLeftOut, take)) {
                if (size == "~") continue;
                elements[kept] = type.object->standIn;
            }
            ++kept;
        }
        elements.resize(kept);
        return std::move(value);
    }

    /// Truncates a vector to its length. Colours, the only bounded vectors of four, may lack alpha.
    void takeLength(Json& value, std::string_view size, const Type& type, const Place& place) {
        std::size_t length = 0;
        std::from_chars(size.data(), size.data() + size.size(), length);
        if (value.size() == length) return;
        const bool isOpaque = length == 4 && value.size() == 3 && type.least == 0.0;
        const std::string flaw = fmt::format("must hold {} numbers, but holds {}", length, value.size());
        if (value.size() < length && !isOpaque) fail(place, "{}", flaw);
        note(place, isOpaque ? "its alpha is 1" : "the numbers beyond are left out", "{}", flaw);
        if (isOpaque)
            value.push_back(1.0);
        else
            value.erase(value.begin() + std::ptrdiff_t(length), value.end());
    }

    Json single(Json& value, const Type& type, bool isValue, const Place& place) {
        switch (type.kind) {
        case Kind::Struct:
            return object(value, *type.object, place);
        case Kind::Object:
            require(value.is_object(), "an object", value, place);
            return Json::object();
        case Kind::Flag:
            if (value == 0 || value == 1) {
                note(place, "1 is taken as true, 0 as false", "must be true or false, but is {}", value.dump());
                return value == 1;
            }
            require(value.is_boolean(), "true or false", value, place);
            return value;
        case Kind::Label:
            return value.is_string() ? std::move(value) : Json("");
        case Kind::Text:
        case Kind::Choice:
            require(value.is_string(), "a string", value, place);
            if (type.kind == Kind::Choice &&
                std::ranges::find(type.choices, value.get_ref<const std::string&>()) == type.choices.end())
                fail(place, "is '{:.40}'; valid are {}", value.get_ref<const std::string&>(),
                     fmt::join(type.choices, ", "));
            return std::move(value);
        case Kind::Number:
            return number(value, type, place);
        default:
            break;
        }
        const std::int64_t number = integer(value, type, place);
        if (type.kind == Kind::Code && std::ranges::find(type.choices, std::to_string(number)) == type.choices.end())
            fail(place, "is {}; valid are {}", number, fmt::join(type.choices, ", "));
        if (type.kind == Kind::Index) requireElement(std::size_t(number), type.array, place);
        // tinygltf keeps the low 32 bits of integers in extensions.
        if (isValue && number > std::int64_t(kMaxInt)) return double(number);
        return number < 0 ? Json(number) : Json(std::uint64_t(number));
    }

    void requireElement(std::size_t index, std::string_view path, const Place& place) {
        Array& array = arrays_.find(path)->second;
        if (!array.missing.empty())
            fail(place, "points at /{}/{}, but the document has no {}", path, index, array.missing);
        if (!array.type.empty()) fail(array.place, "must be an array, but is {}", array.type);
        if (index >= array.states.size())
            fail(place, "points at /{}/{}, but there are only {}", path, index, array.states.size());
        use(array, index);
    }

    /// Rejects numbers that overflow a float, because the scene stores floats.
    double number(const Json& value, const Type& type, const Place& place) const {
        require(value.is_number(), "a number", value, place);
        const double number = value.get<double>();
        if (!(std::abs(number) <= kMaxFloat)) fail(place, "is {}, which no 32-bit number can hold", value.dump());
        const std::string flaw = outOfBounds(number, type);
        if (flaw.empty()) return number;
        if (type.isMoreThanLeast) fail(place, "{}", flaw);
        note(place, kClamped, "{}", flaw);
        return std::clamp(number, type.least, type.most);
    }

    std::int64_t integer(const Json& value, const Type& type, const Place& place) const {
        require(value.is_number(), "an integer", value, place);
        const double number = value.get<double>();
        if (!std::isfinite(number) || number != std::floor(number))
            fail(place, "must be an integer, but is {}", value.dump());
        if (std::abs(number) > kMaxInteger)
            fail(place, "is {}, farther from 0 than {}", value.dump(), std::int64_t(kMaxInteger));
        if (const std::string flaw = outOfBounds(number, type); !flaw.empty()) fail(place, "{}", flaw);
        const auto whole = std::int64_t(number);
        if (whole % type.divisor != 0) fail(place, "is {}; it must be a multiple of {}", whole, type.divisor);
        return whole;
    }

    static std::string outOfBounds(double number, const Type& type) {
        if (type.isMoreThanLeast && !(number > type.least))
            return fmt::format("is {}; more than {} is needed", number, type.least);
        if (number < type.least) return fmt::format("is {}; it must be at least {}", number, type.least);
        if (number > type.most) return fmt::format("is {}; it must be at most {}", number, type.most);
        return {};
    }

    void require(bool isGood, std::string_view type, const Json& value, const Place& place) const {
        if (!isGood) fail(place, "must be {}, but is {}", type, value.type_name());
    }

    template <typename... Values>
    void note(const Place& place, std::string_view repair, fmt::format_string<Values...> flaw,
              Values&&... values) const {
        repairs_.note(file_, place.text(), repair, flaw, std::forward<Values>(values)...);
    }

    template <typename... Values>
    [[noreturn]] void fail(const Place& place, fmt::format_string<Values...> what, Values&&... values) const {
        throw InputError(
            fmt::format("{}: {}: {}", file_, place.text(), fmt::format(what, std::forward<Values>(values)...)));
    }

    void charge(std::uint64_t bytes, const Place& place, std::size_t count) const {
        ledger_.charge(bytes, [&] { return fmt::format("{}: {}, {} elements", file_, place.text(), count); });
    }

    Json& document_;
    const std::string& file_;
    LoadLedger& ledger_;
    Repairs& repairs_;
    const Place root_;
    std::map<std::string_view, Array> arrays_;
    std::vector<std::pair<Array*, std::size_t>> waiting_;
};

} // namespace

Json checkedProperties(Json& document, const std::string& file, LoadLedger& ledger, Repairs& repairs) {
    return Checker(document, file, ledger, repairs).check();
}

} // namespace tessera::scenes::gltf
