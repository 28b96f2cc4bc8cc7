#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>
#include <vector>

#include "core/file/printable.hpp"
#include "core/mesh/file_claims.hpp"

namespace nextview {
namespace {

enum class Encoding { text, little_endian, big_endian };

/// A scalar, or a list: a count of its own type, then as many scalars.
struct Property {
  std::size_t size;        ///< of a scalar [bytes]
  std::size_t count_size;  ///< of a list's count [bytes]; 0: not a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_lists() const {
    for (const Property& property : properties)
      if (property.count_size) return true;
    return false;
  }
};

struct ClaimedHeader {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::string_view body;
};

/// 0 for what is not a type.
std::size_t type_size(std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32" || type == "float" || type == "float32")
    return 4;
  return type == "double" || type == "float64" ? 8 : 0;
}

bool read_format(std::istringstream& words, ClaimedHeader& header) {
  std::string format;
  words >> format;
  header.encoding = format == "binary_little_endian" ? Encoding::little_endian
                    : format == "binary_big_endian"  ? Encoding::big_endian
                                                     : Encoding::text;
  return header.encoding != Encoding::text || format == "ascii";
}

bool read_element(std::istringstream& words, ClaimedHeader& header) {
  Element element;
  std::string count;
  words >> element.name >> count;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  header.elements.push_back(element);
  return error == std::errc() && end == count.data() + count.size() && !count.empty();
}

bool read_property(std::istringstream& words, ClaimedHeader& header) {
  std::string type, count_type;
  words >> type;
  const bool list = type == "list";
  if (list) words >> count_type >> type;
  const Property property = {type_size(type), list ? type_size(count_type) : 0};
  if (header.elements.empty() || property.size == 0 || (list && property.count_size == 0)) return false;
  header.elements.back().properties.push_back(property);
  return true;
}

/// @return what is wrong, or an empty string
std::string read_header(std::string_view bytes, ClaimedHeader& header) {
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r")) return "does not begin with 'ply'";
  for (std::size_t end; (end = bytes.find('\n')) != std::string_view::npos;) {
    const std::string line(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "end_header") {
      header.body = bytes;
      return "";
    }
    const bool good = keyword == "format"    ? read_format(words, header)
                      : keyword == "element" ? read_element(words, header)
                      : keyword == "property"
                          ? read_property(words, header)
                          : keyword == "ply" || keyword == "comment" || keyword == "obj_info" || keyword.empty();
    if (!good)
      return fmt::format("its PLY header has a line that is not understood: '{}'", printable(line.substr(0, 60)));
  }
  return "its PLY header has no end; it may be truncated";
}

/// Steps over scalars without reading more than the counts of lists. Every step says whether the body was long enough.
class Body {
 public:
  Body(std::string_view bytes, Encoding encoding) : bytes_(bytes), encoding_(encoding) {}

  /// False at once if `count` scalars of `size` bytes cannot be there, however large the numbers are.
  bool skip(std::uint64_t count, std::size_t size) {
    if (encoding_ == Encoding::text) {
      if (count > bytes_.size()) return false;
      for (std::uint64_t i = 0; i < count; ++i)
        if (take_word().empty()) return false;
      return true;
    }
    if (count > bytes_.size() / size) return false;
    bytes_.remove_prefix(count * size);
    return true;
  }

  std::optional<std::uint64_t> take_list_count(std::size_t size) {
    std::uint64_t count = 0;
    if (encoding_ == Encoding::text) {
      const std::string_view word = take_word();
      if (std::from_chars(word.data(), word.data() + word.size(), count).ec != std::errc()) return std::nullopt;
      return count;
    }
    if (size > bytes_.size() || size > 4) return std::nullopt;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t at = encoding_ == Encoding::big_endian ? i : size - 1 - i;
      count = count << 8 | static_cast<unsigned char>(bytes_[at]);
    }
    bytes_.remove_prefix(size);
    return count;
  }

 private:
  std::string_view take_word() {
    constexpr std::string_view blanks = " \t\r\n";
    bytes_.remove_prefix(std::min(bytes_.size(), bytes_.find_first_not_of(blanks)));
    const std::string_view word = bytes_.substr(0, bytes_.find_first_of(blanks));
    bytes_.remove_prefix(word.size());
    return word;
  }

  std::string_view bytes_;
  Encoding encoding_;
};

/// Whether all of an element's rows are in the body.
bool skip_element(Body& body, const Element& element, Encoding encoding) {
  if (!element.has_lists()) {
    std::size_t row = 0;
    for (const Property& property : element.properties) row += encoding == Encoding::text ? 1 : property.size;
    if (row == 0) return true;
    return encoding == Encoding::text ? element.count <= UINT64_MAX / row && body.skip(element.count * row, 1)
                                      : body.skip(element.count, row);
  }
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      const std::optional<std::uint64_t> count = property.count_size ? body.take_list_count(property.count_size) : 1;
      if (!count || !body.skip(*count, property.size)) return false;
    }
  return true;
}

}  // namespace

std::string false_ply_claim(std::string_view bytes) {
  ClaimedHeader header;
  if (std::string reason = read_header(bytes, header); !reason.empty()) return reason;
  Body body(header.body, header.encoding);
  for (const Element& element : header.elements)
    if (!skip_element(body, element, header.encoding))
      return fmt::format("its PLY header claims {} of '{}', but the file ends before that; it may be truncated",
                         element.count, element.name);
  return "";
}

}  // namespace nextview
