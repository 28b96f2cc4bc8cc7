#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace nextview {

/// What is copied as it is. Padding would make bytes depend on chance, so values are written one by one but for these.
template <class Value>
concept PlainValue = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

/// Values as bytes, of the machine that writes them, given to a sink some at a time.
class ByteWriter {
 public:
  explicit ByteWriter(std::function<void(std::string_view)> sink) : sink_(std::move(sink)) {}
  /// Gives it the rest. Call it at the end.
  void finish() {
    sink_(waiting_);
    waiting_.clear();
  }
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }

 private:
  void append(const void* data, std::size_t size) {
    constexpr std::size_t many = std::size_t{1} << 20;
    if (waiting_.size() + size > many) finish();
    const std::string_view bytes(static_cast<const char*>(data), size);
    if (size > many)
      sink_(bytes);
    else
      waiting_ += bytes;
  }
  template <PlainValue Value>
  void put(const Value& value) {
    append(&value, sizeof value);
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
      append(values.data(), values.size() * sizeof(Value));
    else
      for (const Value& value : values) put(value);
  }
  template <class Value, std::size_t size>
  void put(const std::array<Value, size>& values) {
    for (const Value& value : values) put(value);
  }

  std::function<void(std::string_view)> sink_;
  std::string waiting_;
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
