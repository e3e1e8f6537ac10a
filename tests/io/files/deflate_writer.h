// SPDX-License-Identifier: MIT
// Writes deflate data (RFC 1951) from given tokens: stored, with the fixed codes, or with random
// prefix codes of any depth. What the data must decompress to follows from the tokens alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"

namespace deliso::test {

// A literal (length 0) or a match.
struct Token {
  int length = 0;
  int value = 0;  // the literal's byte, or the match's distance
};

inline std::string expand(const std::vector<Token>& tokens) {
  std::string out;
  for (const Token& token : tokens) {
    if (token.length == 0) out += static_cast<char>(token.value);
    for (int n = 0; n < token.length; ++n)
      out += out[out.size() - static_cast<std::size_t>(token.value)];
  }
  return out;
}

inline std::vector<Token> literals(const std::string& bytes) {
  std::vector<Token> tokens;
  for (char c : bytes) tokens.push_back({0, static_cast<unsigned char>(c)});
  return tokens;
}

// Literals and matches of every length and distance that is possible so far.
inline std::vector<Token> random_tokens(Random& random, int count) {
  std::vector<Token> tokens;
  const std::uint32_t alphabet = 1 + random.below(256);
  int size = 0;
  for (int n = 0; n < count; ++n) {
    if (size == 0 || random.below(3) == 0) {
      tokens.push_back({0, static_cast<int>(random.below(alphabet))});
      ++size;
      continue;
    }
    const std::uint32_t farthest = static_cast<std::uint32_t>(std::min(size, 32768));
    const std::uint32_t reach = random.below(2) ? farthest : std::min(farthest, 12u);
    const int length = random.below(8) == 0 ? 258 : 3 + static_cast<int>(random.below(256));
    tokens.push_back({length, 1 + static_cast<int>(random.below(reach))});
    size += length;
  }
  return tokens;
}

class DeflateWriter {
 public:
  enum class Block { stored, fixed, dynamic };

  // Appends the tokens as one block (stored: as many as needed).
  void block(Block kind, const std::vector<Token>& tokens, bool last, Random& random) {
    if (kind == Block::stored) return stored(expand(tokens), last);
    put(last, 1);
    put(kind == Block::fixed ? 1 : 2, 2);
    std::vector<int> literal_lengths(288), distance_lengths(32, 5);
    for (std::size_t n = 0; n < 288; ++n)
      literal_lengths[n] = n < 144 ? 8 : n < 256 ? 9 : n < 280 ? 7 : 8;
    if (kind == Block::dynamic) choose_codes(tokens, random, literal_lengths, distance_lengths);
    const std::vector<std::uint32_t> literal_codes = canonical(literal_lengths);
    const std::vector<std::uint32_t> distance_codes = canonical(distance_lengths);
    for (const Token& token : tokens) {
      if (token.length == 0) {
        put_code(literal_codes, literal_lengths, static_cast<std::size_t>(token.value));
        continue;
      }
      const Symbol length = length_symbol(token.length), distance = distance_symbol(token.value);
      put_code(literal_codes, literal_lengths, length.symbol);
      put(length.extra, length.extra_bits);
      put_code(distance_codes, distance_lengths, distance.symbol);
      put(distance.extra, distance.extra_bits);
    }
    put_code(literal_codes, literal_lengths, 256);
  }

  std::string finish() {
    while (used_ % 8 != 0) put(0, 1);
    return bytes_;
  }

 private:
  struct Symbol {
    std::size_t symbol;
    std::uint32_t extra;
    int extra_bits;
  };

  // RFC 1951, 3.2.5, as rules: from 11 on four length codes share a number of extra bits, from 5 on
  // two distance codes.
  static Symbol length_symbol(int length) {
    if (length == 258) return {285, 0, 0};
    int base = 3, extra = 0;
    for (std::size_t symbol = 257;; ++symbol) {
      if (symbol >= 265 && (symbol - 265) % 4 == 0) ++extra;
      if (length < base + (1 << extra))
        return {symbol, static_cast<std::uint32_t>(length - base), extra};
      base += 1 << extra;
    }
  }
  static Symbol distance_symbol(int distance) {
    int base = 1, extra = 0;
    for (std::size_t symbol = 0;; ++symbol) {
      if (symbol >= 4 && symbol % 2 == 0) ++extra;
      if (distance < base + (1 << extra))
        return {symbol, static_cast<std::uint32_t>(distance - base), extra};
      base += 1 << extra;
    }
  }

  void put(std::uint32_t value, int bits) {
    for (int n = 0; n < bits; ++n, ++used_) {
      if (used_ % 8 == 0) bytes_ += '\0';
      bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) |
                                        (value >> n & 1u) << (used_ % 8));
    }
  }
  void put_code(const std::vector<std::uint32_t>& codes, const std::vector<int>& lengths,
                std::size_t symbol) {
    for (int n = lengths[symbol] - 1; n >= 0; --n) put(codes[symbol] >> n, 1);
  }

  void stored(const std::string& bytes, bool last) {
    std::size_t at = 0;
    do {
      const std::size_t n = std::min<std::size_t>(bytes.size() - at, 65535);
      put(last && at + n == bytes.size(), 1);
      put(0, 2);
      while (used_ % 8 != 0) put(0, 1);
      put(static_cast<std::uint32_t>(n), 16);
      put(static_cast<std::uint32_t>(n) ^ 0xffffu, 16);
      bytes_ += bytes.substr(at, n);
      used_ += 8 * n;
      at += n;
    } while (at < bytes.size());
  }

  // The codes of RFC 1951, 3.2.2: by length, then by symbol.
  static std::vector<std::uint32_t> canonical(const std::vector<int>& lengths) {
    std::vector<std::uint32_t> codes(lengths.size());
    std::uint32_t code = 0;
    for (int length = 1; length <= 15; ++length, code <<= 1)
      for (std::size_t n = 0; n < lengths.size(); ++n)
        if (lengths[n] == length) codes[n] = code++;
    return codes;
  }

  // Depths of the leaves of a random binary tree, some of them very deep.
  static std::vector<int> random_depths(Random& random, std::size_t leaves, int deepest) {
    std::vector<int> depths{leaves == 1 ? 1 : 0};
    const bool skewed = random.below(2) == 0;
    while (depths.size() < leaves) {
      std::size_t n = skewed && random.below(4) != 0
                          ? depths.size() - 1
                          : random.below(static_cast<std::uint32_t>(depths.size()));
      while (depths[n] == deepest) n = (n + 1) % depths.size();
      depths.push_back(++depths[n]);
    }
    return depths;
  }
  static std::vector<int> random_code(Random& random, const std::vector<bool>& used, int deepest) {
    std::vector<int> lengths(used.size());
    const auto leaves = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    if (leaves == 0) return lengths;
    std::vector<int> depths = random_depths(random, leaves, deepest);
    for (std::size_t n = 0; n < used.size(); ++n) {
      if (!used[n]) continue;
      const std::size_t at = random.below(static_cast<std::uint32_t>(depths.size()));
      lengths[n] = depths[at];
      depths.erase(depths.begin() + static_cast<std::ptrdiff_t>(at));
    }
    return lengths;
  }

  // Chooses the two codes and writes their description (RFC 1951, 3.2.7).
  void choose_codes(const std::vector<Token>& tokens, Random& random,
                    std::vector<int>& literal_lengths, std::vector<int>& distance_lengths) {
    std::vector<bool> literal_used(286), distance_used(30);
    literal_used[256] = true;
    for (const Token& token : tokens) {
      if (token.length == 0) {
        literal_used[static_cast<std::size_t>(token.value)] = true;
      } else {
        literal_used[length_symbol(token.length).symbol] = true;
        distance_used[distance_symbol(token.value).symbol] = true;
      }
    }
    literal_lengths = random_code(random, literal_used, 15);
    distance_lengths = random_code(random, distance_used, 15);
    while (literal_lengths.back() == 0 && literal_lengths.size() > 257) literal_lengths.pop_back();
    while (distance_lengths.back() == 0 && distance_lengths.size() > 1) distance_lengths.pop_back();

    std::vector<int> all = literal_lengths;
    all.insert(all.end(), distance_lengths.begin(), distance_lengths.end());
    const std::vector<Run> runs = run_lengths(all, random);
    std::vector<bool> used(19);
    for (const Run& run : runs) used[run.symbol] = true;
    const std::vector<int> run_code_lengths = random_code(random, used, 7);
    constexpr std::array<std::size_t, 19> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                   11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::size_t count = 19;
    while (count > 4 && run_code_lengths[order[count - 1]] == 0) --count;
    put(static_cast<std::uint32_t>(literal_lengths.size() - 257), 5);
    put(static_cast<std::uint32_t>(distance_lengths.size() - 1), 5);
    put(static_cast<std::uint32_t>(count - 4), 4);
    for (std::size_t n = 0; n < count; ++n)
      put(static_cast<std::uint32_t>(run_code_lengths[order[n]]), 3);
    const std::vector<std::uint32_t> codes = canonical(run_code_lengths);
    for (const Run& run : runs) {
      put_code(codes, run_code_lengths, run.symbol);
      put(run.extra, run.symbol < 16 ? 0 : run.symbol == 16 ? 2 : run.symbol == 17 ? 3 : 7);
    }
  }

  struct Run {
    std::size_t symbol;
    std::uint32_t extra;
  };
  // Code lengths, with repetitions written as runs whenever chance says so.
  static std::vector<Run> run_lengths(const std::vector<int>& lengths, Random& random) {
    std::vector<Run> runs;
    for (std::size_t n = 0; n < lengths.size();) {
      std::size_t same = 1;
      while (n + same < lengths.size() && lengths[n + same] == lengths[n]) ++same;
      const bool repeats_previous = n > 0 && lengths[n - 1] == lengths[n];
      if (lengths[n] == 0 && same >= 11 && random.below(4) != 0) {
        const std::size_t take = std::min<std::size_t>(same, 11 + random.below(128));
        runs.push_back({18, static_cast<std::uint32_t>(take - 11)});
        n += take;
      } else if (lengths[n] == 0 && same >= 3 && random.below(4) != 0) {
        const std::size_t take = std::min<std::size_t>(same, 3 + random.below(8));
        runs.push_back({17, static_cast<std::uint32_t>(take - 3)});
        n += take;
      } else if (repeats_previous && same >= 3 && random.below(4) != 0) {
        const std::size_t take = std::min<std::size_t>(same, 3 + random.below(4));
        runs.push_back({16, static_cast<std::uint32_t>(take - 3)});
        n += take;
      } else {
        runs.push_back({static_cast<std::size_t>(lengths[n]), 0});
        ++n;
      }
    }
    return runs;
  }

  std::string bytes_;
  std::size_t used_ = 0;  // bits
};

// Bit by bit, after the definitions.
inline std::uint32_t slow_crc32(const std::string& bytes) {
  std::uint32_t c = 0xffffffffu;
  for (char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int n = 0; n < 8; ++n) c = c & 1 ? c >> 1 ^ 0xedb88320u : c >> 1;
  }
  return ~c;
}
inline std::uint32_t slow_adler32(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

inline std::string little(std::uint64_t value, int bytes) {
  std::string out;
  for (; bytes > 0; --bytes, value >>= 8) out += static_cast<char>(value & 0xff);
  return out;
}
inline std::string big(std::uint64_t value, int bytes) {
  std::string out = little(value, bytes);
  std::reverse(out.begin(), out.end());
  return out;
}

inline std::string gzip_wrapped(const std::string& deflated, const std::string& content) {
  return std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03", 10) + deflated +
         little(slow_crc32(content), 4) + little(content.size(), 4);
}
inline std::string zlib_wrapped(const std::string& deflated, const std::string& content) {
  return "\x78\x9c" + deflated + big(slow_adler32(content), 4);
}

// Some gzip or zlib data that holds `content`: a mixture of block kinds, chosen by the seed.
inline std::string deflated(const std::string& content, std::uint64_t seed) {
  Random random(seed);
  DeflateWriter writer;
  std::size_t at = 0;
  do {
    const std::size_t n = std::min<std::size_t>(content.size() - at, 1 + random.below(20000));
    const auto kind = static_cast<DeflateWriter::Block>(random.below(3));
    writer.block(kind, literals(content.substr(at, n)), at + n == content.size(), random);
    at += n;
  } while (at < content.size());
  return writer.finish();
}
inline std::string gzipped(const std::string& content, std::uint64_t seed = 1) {
  return gzip_wrapped(deflated(content, seed), content);
}
inline std::string zlibbed(const std::string& content, std::uint64_t seed = 1) {
  return zlib_wrapped(deflated(content, seed), content);
}

}  // namespace deliso::test
