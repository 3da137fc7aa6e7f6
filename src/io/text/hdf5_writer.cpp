#include "io/text/hdf5_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "hexwright/base/assert.h"
#include "hexwright/base/cancel.h"

#include "io/text/byte_reader.h"

namespace hexwright::io {
namespace {

constexpr std::uint64_t kNowhere = ~std::uint64_t{0};
constexpr std::size_t kSuperblockSize = 48;

enum Message : std::uint8_t {
  Dataspace = 1,
  LinkInfo = 2,
  Datatype = 3,
  FillValue = 5,
  Link = 6,
  Layout = 8,
  GroupInfo = 10,
  Attribute = 12
};

template <class Number>
void put(std::string& out, Number value) {
  store(out, value, ByteOrder::Little);
}

// Based on: Jenkins, "lookup3", 2006 (public domain): hashlittle with the initial value 0, which
// the format names as its checksum.
struct Lookup3 {
  std::uint32_t a, b, c;

  void mix() {
    a -= c, a ^= std::rotl(c, 4), c += b;
    b -= a, b ^= std::rotl(a, 6), a += c;
    c -= b, c ^= std::rotl(b, 8), b += a;
    a -= c, a ^= std::rotl(c, 16), c += b;
    b -= a, b ^= std::rotl(a, 19), a += c;
    c -= b, c ^= std::rotl(b, 4), b += a;
  }
  void finish() {
    c ^= b, c -= std::rotl(b, 14);
    a ^= c, a -= std::rotl(c, 11);
    b ^= a, b -= std::rotl(a, 25);
    c ^= b, c -= std::rotl(b, 16);
    a ^= c, a -= std::rotl(c, 4);
    b ^= a, b -= std::rotl(a, 14);
    c ^= b, c -= std::rotl(b, 24);
  }
};

// Class, its bits and the size, then its properties (version 1).
std::string datatype(int kind, std::uint32_t bits, std::size_t size) {
  std::string type(1, static_cast<char>(0x10 | kind));
  for (int k = 0; k < 3; ++k) type += static_cast<char>(bits >> (8 * k));
  put(type, static_cast<std::uint32_t>(size));
  return type;
}

std::string integer_type(std::size_t size, bool is_signed) {
  std::string type = datatype(0, is_signed ? 0x08 : 0, size);
  put(type, std::uint16_t{0});
  put(type, static_cast<std::uint16_t>(8 * size));
  return type;
}

// IEEE's: the mantissa's first bit is implied.
std::string float_type(bool is_double) {
  std::string type = datatype(1, is_double ? 0x3f20 : 0x1f20, is_double ? 8 : 4);
  put(type, std::uint16_t{0});
  put(type, static_cast<std::uint16_t>(is_double ? 64 : 32));
  for (int value : is_double ? std::array{52, 11, 0, 52} : std::array{23, 8, 0, 23})
    type += static_cast<char>(value);
  put(type, std::uint32_t{is_double ? 1023u : 127u});
  return type;
}

// Of one dimension (version 2, which arrays need).
std::string array_type(std::size_t length, const std::string& base) {
  std::string type = datatype(10, 0, length);
  type[0] = 0x2a;
  put(type, std::uint32_t{1});  // dimensions, and three bytes without a meaning
  put(type, static_cast<std::uint32_t>(length));
  put(type, std::uint32_t{0});
  return type + base;
}

template <class Number>
Hdf5Array numbers(std::string type, std::span<const Number> values,
                  std::vector<std::uint64_t> lengths) {
  Hdf5Array array{std::move(type), std::move(lengths), {}};
  array.data.reserve(values.size_bytes());
  CancelCheck check_cancelled;
  for (Number value : values) {
    check_cancelled();
    put(array.data, value);
  }
  return array;
}

std::string dataspace(const std::vector<std::uint64_t>& lengths) {
  std::string space{2, static_cast<char>(lengths.size()), 0, lengths.empty() ? char{0} : char{1}};
  for (std::uint64_t length : lengths) put(space, length);
  return space;
}

void add_message(std::string& messages, Message kind, const std::string& content) {
  messages += static_cast<char>(kind);
  put(messages, static_cast<std::uint16_t>(content.size()));
  messages += '\0';
  messages += content;
}

void add_attribute(std::string& messages, const std::string& name, const Hdf5Array& array) {
  const std::string space = dataspace(array.lengths);
  std::string content{3, 0};
  for (std::size_t size : {name.size() + 1, array.type.size(), space.size()})
    put(content, static_cast<std::uint16_t>(size));
  content += '\0';  // ASCII
  content += name;
  content += '\0';
  add_message(messages, Attribute, content + array.type + space + array.data);
}

// The array's bytes go first, so that the header knows where they are.
void add_dataset(std::string& messages, const Hdf5Array& array, std::string& out) {
  add_message(messages, Dataspace, dataspace(array.lengths));
  add_message(messages, Datatype, array.type);
  add_message(messages, FillValue, {3, 0x0a});  // allocated late, nothing filled in
  std::string layout{3, 1};
  put(layout, array.data.empty() ? kNowhere : std::uint64_t{out.size()});
  put(layout, std::uint64_t{array.data.size()});
  add_message(messages, Layout, layout);
  out += array.data;
}

std::uint64_t add_header(const std::string& messages, std::string& out) {
  std::string header = "OHDR";
  header += char{2};
  header += char{2};  // four bytes for the size, no times
  put(header, static_cast<std::uint32_t>(messages.size()));
  header += messages;
  put(header, hdf5_checksum(header));
  const std::uint64_t place = out.size();
  out += header;
  return place;
}

}  // namespace

std::uint32_t hdf5_checksum(std::string_view bytes) {
  const auto start = 0xdeadbeef + static_cast<std::uint32_t>(bytes.size());
  Lookup3 state{start, start, start};
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4 && at + k < bytes.size(); ++k)
      value |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
    return value;
  };
  const auto add = [&](std::size_t at) {
    state.a += word(at);
    state.b += word(at + 4);
    state.c += word(at + 8);
  };
  std::size_t at = 0;
  for (; bytes.size() - at > 12; at += 12) {
    add(at);
    state.mix();
  }
  if (at == bytes.size()) return state.c;
  add(at);
  state.finish();
  return state.c;
}

Hdf5Array hdf5_ints(std::span<const std::int32_t> values, std::vector<std::uint64_t> lengths) {
  return numbers(integer_type(4, true), values, std::move(lengths));
}

Hdf5Array hdf5_longs(std::span<const std::int64_t> values, std::vector<std::uint64_t> lengths) {
  return numbers(integer_type(8, true), values, std::move(lengths));
}

Hdf5Array hdf5_bytes(std::string_view values, bool is_signed) {
  return {integer_type(1, is_signed), {values.size()}, std::string(values)};
}

Hdf5Array hdf5_doubles(std::span<const double> values, std::vector<std::uint64_t> lengths) {
  return numbers(float_type(true), values, std::move(lengths));
}

Hdf5Array hdf5_floats(std::span<const float> values) {
  return numbers(float_type(false), values, {values.size()});
}

Hdf5Array hdf5_int(std::int32_t value) { return hdf5_ints({&value, 1}, {}); }

Hdf5Array hdf5_double(double value) { return hdf5_doubles({&value, 1}, {}); }

Hdf5Array hdf5_text(std::string_view text, std::size_t size) {
  if (size == 0) size = std::max<std::size_t>(text.size(), 1);
  Hdf5Array array{datatype(3, 0x01, size), {}, std::string(text.substr(0, size))};
  array.data.resize(size);
  return array;
}

Hdf5Array hdf5_text_rows(const std::vector<std::string>& texts, std::size_t size) {
  Hdf5Array array{array_type(size, integer_type(1, true)), {texts.size()}, {}};
  for (std::string text : texts) {
    text.resize(size);
    array.data += text;
  }
  return array;
}

Hdf5Node& Hdf5Node::child(const std::string& name) {
  const auto found = std::find_if(links_.begin(), links_.end(),
                                  [&](const Link& link) { return link.name == name; });
  if (found != links_.end()) return *found->node;
  return *links_.emplace_back(Link{name, std::make_unique<Hdf5Node>(), {}}).node;
}

Hdf5Node& Hdf5Node::dataset(const std::string& name, Hdf5Array array) {
  Hdf5Node& node = child(name);
  HEXWRIGHT_ASSERT(!node.array_ && node.links_.empty());
  node.array_ = std::make_unique<Hdf5Array>(std::move(array));
  return node;
}

void Hdf5Node::attribute(const std::string& name, Hdf5Array array) {
  attributes_.emplace_back(name, std::move(array));
}

void Hdf5Node::soft_link(const std::string& name, const std::string& path) {
  links_.push_back({name, nullptr, path});
}

// In the order of their making, which the links tell.
void Hdf5Node::add_links(std::string& messages, const std::vector<std::uint64_t>& places) const {
  std::string info{0, 1};
  put(info, std::uint64_t{links_.size()});
  put(info, kNowhere);
  put(info, kNowhere);
  add_message(messages, LinkInfo, info);
  add_message(messages, GroupInfo, {0, 0});
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    std::string content{1, link.node ? char{0x05} : char{0x0d}};  // two bytes for a name's length
    if (!link.node) content += char{1};
    put(content, std::uint64_t{i});
    put(content, static_cast<std::uint16_t>(link.name.size()));
    content += link.name;
    if (link.node) {
      put(content, places[i]);
    } else {
      put(content, static_cast<std::uint16_t>(link.path.size()));
      content += link.path;
    }
    add_message(messages, Message::Link, content);
  }
}

std::uint64_t Hdf5Node::write(std::string& out) const {
  std::string messages;
  if (array_) {
    add_dataset(messages, *array_, out);
  } else {
    std::vector<std::uint64_t> places;
    for (const Link& link : links_) places.push_back(link.node ? link.node->write(out) : kNowhere);
    add_links(messages, places);
  }
  for (const auto& [name, array] : attributes_) add_attribute(messages, name, array);
  return add_header(messages, out);
}

std::string Hdf5Node::file() const {
  std::string out(kSuperblockSize, '\0');
  const std::uint64_t root = write(out);
  std::string block = "\x89HDF\r\n\x1a\n";
  for (char value : {2, 8, 8, 0}) block += value;  // version, bytes of offsets and of lengths
  for (std::uint64_t value : {std::uint64_t{0}, kNowhere, std::uint64_t{out.size()}, root})
    put(block, value);
  put(block, hdf5_checksum(block));
  out.replace(0, kSuperblockSize, block);
  return out;
}

}  // namespace hexwright::io
