#include "base/Sha256.h"

#include <span>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace tessera {
namespace {

std::string hashOf(std::string_view text, std::size_t piece) {
    Sha256 hash;
    for (std::size_t i = 0; i < text.size(); i += piece) hash.add(std::as_bytes(std::span(text.substr(i, piece))));
    return hexadecimal(hash.digest());
}

/// Source: NIST, "SHA-256 examples" to FIPS 180-4, and its long test of a million letters.
TEST(Sha256, publishedTextsHaveTheirPublishedHashes) {
    EXPECT_EQ(hashOf("", 1), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(hashOf("abc", 1), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hashOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 5),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(hashOf(std::string(1'000'000, 'a'), 999),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

} // namespace
} // namespace tessera
