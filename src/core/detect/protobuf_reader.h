#pragma once
// The protobuf wire format, as far as walking over a message needs it.
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace field_fusion::core {

/// Steps over the fields of one message without copying. Every length is checked against the bytes
/// that are left, in 64 bits; std::runtime_error where the bytes are no message.
class ProtobufReader {
 public:
  explicit ProtobufReader(std::string_view message) : rest_(message) {}

  /// Goes to the next field; false at the end of the message.
  bool next() {
    if (rest_.empty()) return false;
    const std::uint64_t key = varint();
    field_ = key >> 3;
    type_ = key & 7;
    number_ = 0;
    bytes_ = {};
    if (field_ == 0) throw std::runtime_error("a field has number 0");
    switch (type_) {
      case kVarint:
        number_ = varint();
        break;
      case kFixed64:
        take(8);
        break;
      case kBytes:
        bytes_ = take(varint());
        break;
      case kFixed32:
        take(4);
        break;
      default:
        throw std::runtime_error("a field has an unknown wire type");
    }
    return true;
  }

  bool isBytes(std::uint64_t field) const { return field_ == field && type_ == kBytes; }
  bool isNumber(std::uint64_t field) const { return field_ == field && type_ == kVarint; }
  std::string_view bytes() const { return bytes_; }
  std::uint64_t number() const { return number_; }

 private:
  enum : std::uint64_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(take(1).front());
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    throw std::runtime_error("a number has more than 64 bits");
  }

  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw std::runtime_error("it ends in the middle of a field");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_, bytes_;
  std::uint64_t field_ = 0, type_ = 0, number_ = 0;
};

}  // namespace field_fusion::core
