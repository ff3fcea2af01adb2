#ifndef snug_mesh_file_mesh_text_h
#define snug_mesh_file_mesh_text_h

#include <snug/base/errors.h>

#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace snug::mesh_file {
/// This class reads the text of a mesh file from beginning to end. All functions throw InputErrors
/// that contain the line.
class MeshText
{
public:
  /// @p text must outlive this object.
  explicit MeshText(const std::string &text) : text(text) {}

  /// Return the number of the current line, from 1, or 0 in a binary file.
  unsigned long line() const { return binary ? 0 : line_number; }

  /// Treat the text as binary, without line numbers.
  void be_binary() { binary = true; }

  /// Skip blanks, and return whether the text ends behind them.
  bool at_end();

  /// Return the rest of the line, without blanks at its ends.
  std::string rest_of_line();

  /// Return the next word on this or a later line. If there is none, the message says that @p what
  /// is expected.
  std::string word(const std::string &what);
  /// Return the next word as a finite number.
  double number(const std::string &what);
  /// Return the next word as an integer >= 0.
  unsigned long whole(const std::string &what);

  /// Return the next value of a binary file. @throws InputError if it is not finite.
  template <typename T>
  T raw(const std::string &what);

  /// Move to the end of the next @p mark. @throws InputError if there is none.
  void skip_behind(const std::string &mark);

  /// Throw the error "line 17: message" of the current line.
  [[noreturn]] void fail(const std::string &message) const;

private:
  const std::string &text;
  std::size_t        place       = 0;
  unsigned long      line_number = 1;
  bool               binary      = false;

  [[noreturn]] void fail_at_end(const std::string &what) const;
  void              advance(std::size_t to);
};

/// Return the error "line 17: message", or only the message if @p line is 0.
InputError error_at_line(unsigned long line, const std::string &message);

/// Return @p text shortened and without control characters, because a file may be binary and may
/// contain words of any length.
std::string printable(std::string text);

/// Return @p word as a finite number, or as an integer >= 0. @throws InputError at @p line.
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
      fail(what + " is not finite");
  return value;
}
} // namespace snug::mesh_file

#endif
