#ifndef snug_tests_random_draw_h
#define snug_tests_random_draw_h

#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace snug::test {
/// Random numbers, the same with every library.
class Draw
{
public:
  explicit Draw(unsigned int seed) : generator(seed) {}

  double between(double a, double b)
  {
    return a + (b - a) * (generator() / (double(std::mt19937::max()) + 1.));
  }
  /// One of a, a + 1, .., b.
  unsigned int whole(unsigned int a, unsigned int b)
  {
    return a + unsigned(between(0., b - a + 1.));
  }
  /// Between @p a and @p b, as often below as above sqrt(a b).
  double scale(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  bool   chance(double part) { return between(0., 1.) < part; }
  /// One of them, those given more than once more often.
  std::string one_of(const std::vector<std::string> &choices)
  {
    return choices[whole(0, choices.size() - 1)];
  }

private:
  std::mt19937 generator;
};

/// A parameter file in the making.
class SceneText
{
public:
  template <typename... Values>
  void set(const std::string &entry, const Values &...values)
  {
    out << indent << "set " << entry << " =";
    ((out << ' ' << values), ...);
    out << '\n';
  }
  void begin(const std::string &section)
  {
    out << "subsection " << section << '\n';
    indent = "  ";
  }
  void end()
  {
    out << "end\n";
    indent.clear();
  }
  std::string text() const { return out.str(); }

private:
  std::ostringstream out;
  std::string        indent;
};

/// Numbers, or anything else, one after the other.
template <typename... Values>
std::string join(const Values &...values)
{
  std::ostringstream text;
  ((text << values), ...);
  return text.str();
}
} // namespace snug::test

#endif
