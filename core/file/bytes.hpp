#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace nextview {

/// What is copied as it is. Padding would make bytes depend on chance, so values are written one by one but for these.
template <class Value>
concept PlainValue = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

/// Values as bytes, of the machine that writes them.
class ByteWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  std::string bytes;

 private:
  template <PlainValue Value>
  void put(const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }
  template <class Value>
  void put(const std::optional<Value>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class Value>
  void put(const std::vector<Value>& values) {
    put(std::uint64_t{values.size()});
    if constexpr (PlainValue<Value>)
      bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
    else
      for (const Value& value : values) put(value);
  }
  template <class Value, std::size_t size>
  void put(const std::array<Value, size>& values) {
    for (const Value& value : values) put(value);
  }
};

/// The same values again. Every function @throws std::runtime_error if there are not as many bytes.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (take(values), ...);
  }
  bool at_end() const { return left_.empty(); }

 private:
  std::string_view next(std::uint64_t count) {
    if (count > left_.size()) throw std::runtime_error("it ends too early");
    const std::string_view bytes = left_.substr(0, count);
    left_.remove_prefix(count);
    return bytes;
  }
  template <PlainValue Value>
  void take(Value& value) {
    std::memcpy(&value, next(sizeof value).data(), sizeof value);
  }
  void take(bool& value) {
    std::uint8_t byte = 0;
    take(byte);
    value = byte != 0;
  }
  void take(std::string& text) {
    std::uint64_t size = 0;
    take(size);
    text = next(size);
  }
  template <class Value>
  void take(std::optional<Value>& value) {
    bool there = false;
    take(there);
    value.reset();
    if (there) take(value.emplace());
  }
  template <class Value>
  void take(std::vector<Value>& values) {
    std::uint64_t size = 0;
    take(size);
    constexpr std::size_t least = PlainValue<Value> ? sizeof(Value) : 1;  // [bytes] of a value
    if (size > left_.size() / least) throw std::runtime_error("it ends too early");
    values.resize(size);
    if constexpr (PlainValue<Value>) {
      if (size > 0) std::memcpy(values.data(), next(size * sizeof(Value)).data(), size * sizeof(Value));
    } else {
      for (Value& value : values) take(value);
    }
  }
  template <class Value, std::size_t size>
  void take(std::array<Value, size>& values) {
    for (Value& value : values) take(value);
  }

  std::string_view left_;
};

}  // namespace nextview
