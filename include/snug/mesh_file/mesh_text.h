#ifndef snug_mesh_file_mesh_text_h
#define snug_mesh_file_mesh_text_h

#include <snug/base/errors.h>

#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace snug::mesh_file {
/// Contents of a mesh file, read from front to end. All functions throw
/// InputErrors that name the line.
class MeshText
{
public:
  /// @p text must outlive this object.
  explicit MeshText(const std::string &text) : text(text) {}

  /// Number of the line that is read, from 1; 0 if lines mean nothing.
  unsigned long line() const { return binary ? 0 : line_number; }

  /// Lines mean nothing.
  void be_binary() { binary = true; }

  /// Whether nothing but blanks follows, which are skipped.
  bool at_end();

  /// The rest of the line, without blanks at its ends.
  std::string rest_of_line();

  /// The next word on this or a later line; @p what is expected.
  std::string word(const std::string &what);
  double      number(const std::string &what);
  /// A whole number, 0 or larger.
  unsigned long whole(const std::string &what);

  /// A value as it lies in memory; reals must be finite.
  template <typename T>
  T raw(const std::string &what);

  /// Go on behind the next @p mark. @throws if there is none.
  void skip_behind(const std::string &mark);

  [[noreturn]] void fail(const std::string &message) const;

private:
  const std::string &text;
  std::size_t        place       = 0;
  unsigned long      line_number = 1;
  bool               binary      = false;

  [[noreturn]] void fail_at_end(const std::string &what) const;
  void              advance(std::size_t to);
};

/// "line 17: message", or only the message if there is no line.
InputError error_at_line(unsigned long line, const std::string &message);

/// @p text as a message may show it: the file may be binary, and a word of it huge.
std::string printable(std::string text);

/// Trimmed parts of a line between commas.
std::vector<std::string> comma_list(const std::string &line);

/// @p word as a number, or an error at @p line.
double        to_number(const std::string &word, unsigned long line);
unsigned long to_whole(const std::string &word, unsigned long line);

template <typename T>
T MeshText::raw(const std::string &what)
{
  T value;
  if (text.size() - place < sizeof(T))
    fail_at_end(what);
  std::memcpy(&value, text.data() + place, sizeof(T));
  place += sizeof(T);
  if constexpr (std::is_floating_point_v<T>)
    if (!std::isfinite(value))
      fail(what + " is no number");
  return value;
}
} // namespace snug::mesh_file

#endif
