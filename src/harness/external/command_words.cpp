#include "harness/external/command_words.hpp"

#include <fmt/core.h>

#include <cstddef>

#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

class Splitter {
 public:
  explicit Splitter(std::string_view text) : text_(text) {}

  std::vector<std::string> words() {
    while (!at_end()) {
      const char c = next();
      if (kSpace.find(c) != std::string_view::npos) {
        end_word();
      } else if (c == '\'') {
        add_literally();
      } else if (c == '"') {
        add_quoted();
      } else {
        add(c == '\\' ? following("after a backslash") : c);
      }
    }
    end_word();
    if (words_.empty()) throw InputError("expected a command line, got nothing");
    return words_;
  }

 private:
  static constexpr std::string_view kSpace = " \t\n\r\f\v";
  static constexpr std::string_view kEscapedInQuotes = "\"\\$`";

  bool at_end() const { return place_ == text_.size(); }
  char next() { return text_[place_++]; }

  char following(const char* expected) {
    if (at_end()) {
      throw InputError(fmt::format("expected a character {} in the command line, got its end: {}",
                                   expected, text_));
    }
    return next();
  }

  void add(char c) {
    word_ += c;
    in_word_ = true;
  }

  void add_literally() {
    in_word_ = true;  // '' is an empty word
    for (char c = following("or ' after '"); c != '\''; c = following("or ' after '")) add(c);
  }

  void add_quoted() {
    constexpr const char* kExpected = "or \" after \"";
    in_word_ = true;
    for (char c = following(kExpected); c != '"'; c = following(kExpected)) {
      if (c != '\\') {
        add(c);
        continue;
      }
      const char escaped = following(kExpected);
      if (kEscapedInQuotes.find(escaped) == std::string_view::npos) add('\\');
      add(escaped);
    }
  }

  void end_word() {
    if (in_word_) words_.push_back(word_);
    word_.clear();
    in_word_ = false;
  }

  std::string_view text_;
  std::size_t place_ = 0;
  std::string word_;
  bool in_word_ = false;
  std::vector<std::string> words_;
};

}  // namespace

std::vector<std::string> command_words(std::string_view text) { return Splitter(text).words(); }

}  // namespace bqsa::harness
