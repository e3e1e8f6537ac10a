// SPDX-License-Identifier: MIT
#include "io/files/deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "io/files/checksum.h"

namespace deliso {
namespace {

constexpr std::size_t kWindow = 32768;
constexpr std::size_t kShortest = 3, kLongest = 258;
constexpr int kChain = 128;                  // earlier places tried for a match
constexpr std::size_t kBlockTokens = 32768;  // tokens with the same codes
constexpr std::size_t kEnd = 256;            // the symbol that ends a block
constexpr std::size_t kLengthCodes = 286, kDistanceCodes = 30, kDepthCodes = 16;

// A literal byte (length 0) or a match.
struct Token {
  std::uint16_t length;
  std::uint16_t value;  // the byte, or the distance less 1
};

// A length or a distance as its symbol and the bits that follow it (RFC 1951, 3.2.5). There are
// `group` symbols, a power of two, for each number of extra bits, so each group covers twice the
// range of the last.
struct Symbol {
  std::size_t symbol;
  std::uint32_t extra;
  int extra_bits;
};

Symbol symbol_of(std::uint32_t value, std::uint32_t group) {
  if (value < 2 * group) return {value, 0, 0};
  const int bits = std::bit_width(value) - std::bit_width(group);
  return {group * static_cast<std::uint32_t>(bits) + (value >> bits), value & ((1u << bits) - 1),
          bits};
}

Symbol length_symbol(std::uint16_t length) {
  if (length == kLongest) return {285, 0, 0};
  Symbol found = symbol_of(static_cast<std::uint32_t>(length - kShortest), 4);
  found.symbol += 257;
  return found;
}

Symbol distance_symbol(std::uint16_t less_one) {
  return symbol_of(less_one, 2);
}

// Returns the bytes as tokens. Greedily replaces the bytes at a place by their longest match in the
// window.
std::vector<Token> find_repetitions(std::string_view bytes) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  constexpr int kHashBits = 15;
  std::vector<std::uint32_t> newest(std::size_t{1} << kHashBits, kNone), older(kWindow, kNone);
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  const auto enter = [&](std::size_t at) {
    const std::uint32_t three = byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16;
    std::uint32_t& head = newest[(three * 0x9e3779b1u) >> (32 - kHashBits)];
    older[at % kWindow] = head;
    return std::exchange(head, static_cast<std::uint32_t>(at));
  };

  std::vector<Token> tokens;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t longest = std::min(kLongest, bytes.size() - at);
    if (longest < kShortest) {
      tokens.push_back({0, byte(at++)});
      continue;
    }
    std::size_t length = 0, distance = 0;
    std::uint32_t candidate = enter(at);
    for (int n = 0; n < kChain && candidate != kNone && at - candidate <= kWindow; ++n) {
      // A longer match has the next byte, too.
      std::size_t same = 0;
      if (bytes[candidate + length] == bytes[at + length]) {
        while (same < longest && bytes[candidate + same] == bytes[at + same]) ++same;
      }
      if (same > length) {
        length = same;
        distance = at - candidate;
        if (length == longest) break;
      }
      const std::uint32_t next = older[candidate % kWindow];
      if (next == kNone || next >= candidate) break;  // overwritten in the ring
      candidate = next;
    }
    if (length < kShortest) {
      tokens.push_back({0, byte(at++)});
      continue;
    }
    tokens.push_back(
        {static_cast<std::uint16_t>(length), static_cast<std::uint16_t>(distance - 1)});
    const std::size_t end = at + length;
    for (++at; at < end; ++at) {
      if (at + kShortest <= bytes.size()) enter(at);
    }
  }
  return tokens;
}

struct Code {
  std::vector<int> lengths;         // 0: the symbol does not occur
  std::vector<std::uint32_t> bits;  // first bit lowest, as deflate packs them
};

// Returns the depths of the leaves in the Huffman tree for these counts.
std::vector<int> huffman_depths(std::span<const std::uint32_t> counts) {
  using Entry = std::pair<std::uint64_t, std::size_t>;  // count, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<std::size_t> parent(counts.size());
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] > 0) open.push({counts[s], s});
  }
  while (open.size() > 1) {
    const Entry a = open.top();
    open.pop();
    const Entry b = open.top();
    open.pop();
    parent[a.second] = parent[b.second] = parent.size();
    open.push({a.first + b.first, parent.size()});
    parent.push_back(0);
  }
  // A parent has a higher number than its children, so depths come from the root down.
  std::vector<int> depth(parent.size(), 0);
  for (std::size_t node = parent.size() - 1; node-- > 0;) {
    if (node >= counts.size() || counts[node] > 0) depth[node] = depth[parent[node]] + 1;
  }
  depth.resize(counts.size());
  return depth;
}

// Returns the canonical code (RFC 1951, 3.2.2) of a Huffman tree of at most this depth.
Code make_code(std::vector<std::uint32_t> counts, int deepest) {
  // With two symbols at least, the code is complete.
  for (std::size_t s = 0, used = 0; s < counts.size() && used < 2; ++s) {
    used = static_cast<std::size_t>(
        std::count_if(counts.begin(), counts.end(), [](std::uint32_t n) { return n > 0; }));
    if (used < 2 && counts[s] == 0) counts[s] = 1;
  }
  // Counts that differ less make a tree that is less deep.
  Code code{huffman_depths(counts), std::vector<std::uint32_t>(counts.size())};
  while (*std::max_element(code.lengths.begin(), code.lengths.end()) > deepest) {
    for (std::uint32_t& n : counts) n = (n + 1) / 2;
    code.lengths = huffman_depths(counts);
  }
  std::uint32_t next = 0;
  for (int length = 1; length <= deepest; ++length, next <<= 1) {
    for (std::size_t s = 0; s < counts.size(); ++s) {
      if (code.lengths[s] != length) continue;
      for (int n = 0; n < length; ++n) code.bits[s] |= (next >> n & 1u) << (length - 1 - n);
      ++next;
    }
  }
  return code;
}

class BitWriter {
 public:
  // Begins with the last `count` bits, fewer than 8, in `pending`, and leaves the rest there again.
  BitWriter(std::string& out, std::uint64_t& pending, int& count)
      : out_(out), pending_(pending), count_(count) {}

  void put(std::uint32_t value, int bits) {
    pending_ |= std::uint64_t{value} << count_;
    for (count_ += bits; count_ >= 8; count_ -= 8, pending_ >>= 8) {
      out_ += static_cast<char>(pending_ & 0xff);
    }
  }
  void put(const Code& code, std::size_t symbol) { put(code.bits[symbol], code.lengths[symbol]); }
  void put(const Code& code, const Symbol& symbol) {
    put(code, symbol.symbol);
    put(symbol.extra, symbol.extra_bits);
  }
  void finish() { put(0, (8 - count_) % 8); }

 private:
  std::string& out_;
  std::uint64_t& pending_;
  int& count_;
};

// Writes the lengths of both codes, themselves in a code (RFC 1951, 3.2.7), without the symbols for
// runs.
void put_codes(BitWriter& out, const Code& literal, const Code& distance) {
  constexpr std::array<std::size_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                  11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::vector<int> lengths = literal.lengths;
  lengths.insert(lengths.end(), distance.lengths.begin(), distance.lengths.end());
  std::vector<std::uint32_t> counts(kDepthCodes);
  for (const int length : lengths) ++counts[static_cast<std::size_t>(length)];
  const Code depth = make_code(counts, 7);

  out.put(kLengthCodes - 257, 5);
  out.put(kDistanceCodes - 1, 5);
  out.put(kOrder.size() - 4, 4);
  for (const std::size_t s : kOrder) {
    out.put(s < kDepthCodes ? static_cast<std::uint32_t>(depth.lengths[s]) : 0, 3);
  }
  for (const int length : lengths) out.put(depth, static_cast<std::size_t>(length));
}

void put_block(BitWriter& out, std::span<const Token> tokens, bool last) {
  std::vector<std::uint32_t> literals(kLengthCodes), distances(kDistanceCodes);
  literals[kEnd] = 1;
  for (const Token& token : tokens) {
    if (token.length == 0) {
      ++literals[token.value];
    } else {
      ++literals[length_symbol(token.length).symbol];
      ++distances[distance_symbol(token.value).symbol];
    }
  }
  const Code literal = make_code(std::move(literals), 15);
  const Code distance = make_code(std::move(distances), 15);

  out.put(last ? 1 : 0, 1);
  out.put(2, 2);
  put_codes(out, literal, distance);
  for (const Token& token : tokens) {
    if (token.length == 0) {
      out.put(literal, std::size_t{token.value});
    } else {
      out.put(literal, length_symbol(token.length));
      out.put(distance, distance_symbol(token.value));
    }
  }
  out.put(literal, kEnd);
}

}  // namespace

void DeflateStream::compress(bool last) {
  const std::vector<Token> tokens = find_repetitions(piece_);
  BitWriter writer(data_, bits_, bit_count_);
  std::span<const Token> rest = tokens;
  do {
    const std::size_t n = std::min(kBlockTokens, rest.size());
    put_block(writer, rest.first(n), last && n == rest.size());
    rest = rest.subspan(n);
  } while (!rest.empty());
  if (last) writer.finish();
  sum_ = adler32(std::as_bytes(std::span(piece_)), sum_);
  piece_.clear();
}

std::string DeflateStream::add(std::string_view bytes) {
  bool ready = false;
  while (!bytes.empty()) {
    if (piece_.size() == kPiece) {
      compress(false);
      ready = true;
    }
    const std::size_t n = std::min(bytes.size(), kPiece - piece_.size());
    piece_.append(bytes.substr(0, n));
    bytes.remove_prefix(n);
  }
  return ready ? std::exchange(data_, {}) : std::string();
}

std::string DeflateStream::finish() {
  compress(true);
  for (int shift = 24; shift >= 0 && wrapping_ == Wrapping::zlib; shift -= 8) {
    data_ += static_cast<char>(sum_ >> shift & 0xff);
  }
  return std::exchange(data_, {});
}

std::string deflate_zlib(std::string_view bytes) {
  DeflateStream stream;
  std::string data = stream.add(bytes);
  return data + stream.finish();
}

}  // namespace deliso
