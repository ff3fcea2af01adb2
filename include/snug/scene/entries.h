#ifndef snug_scene_entries_h
#define snug_scene_entries_h

#include <snug/base/choice.h>
#include <snug/scene/statements.h>
#include <snug/scene/values.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace snug::scene {
/**
 * The entries of a parameter file, each bound to the variable it sets: a
 * dealii::ParameterHandler and, what it does not tell, the list of what
 * was declared. The variables must outlive this object.
 */
class Entries
{
public:
  struct Description
  {
    std::string section; ///< "" at the top
    std::string name;
    std::string initial; ///< default value
    Form        form;
    std::string meaning;
  };

  struct Section
  {
    std::string name, meaning;
  };

  /// How a value that is no plain variable is read and written.
  struct Access
  {
    std::function<std::string()>             text;
    std::function<void(const std::string &)> assign;
  };

  /// Entries added from here on belong to this subsection.
  void begin_section(const std::string &name, const std::string &meaning);

  void
  add(const std::string &name, const Access &access, const Form &form, const std::string &meaning);

  template <typename T>
  void add(const std::string &name, T &value, const std::string &meaning)
  {
    add(name, value, form_of(value), meaning);
  }

  template <typename T>
  void add(const std::string &name, T &value, const Form &form, const std::string &meaning)
  {
    const Access access{[&value]() { return to_text(value); },
                        [&value](const std::string &text) { from_text(text, value); }};
    add(name, access, form, meaning);
  }

  /// Assign a value, or nothing if the statement only opens a subsection.
  /// @throws InputError, one line, if there is no such entry or
  /// subsection, or the value has the wrong form.
  void set(const Statement &statement);

  /// Every entry with its value, readable by parse_statements().
  void print(std::ostream &out) const;

  const std::vector<Section> &sections() const;

  const std::vector<Description> &descriptions() const;

private:
  /// Throw, unless the statement only opens a subsection there is.
  void reject_unknown(const Statement &statement) const;

  dealii::ParameterHandler prm;
  std::vector<Section>     section_list = {{"", ""}};
  std::vector<Description> list;
};

/// A choice from a factory table. Of tables for 2D and 3D, which have the
/// same names, the one for 3D is passed.
template <typename Make>
void add_choice(Entries                 &entries,
                const std::string       &name,
                std::string             &value,
                const ChoiceTable<Make> &table,
                const std::string       &meaning)
{
  entries.add(name, value, choice(names(table)), meaning + " " + meanings(table) + ".");
}

/// Declare all entries of @p scene, with its values as defaults. The
/// bodies, obstacles, pairs and shapes there are get their subsections.
void declare(Entries &entries, Scene &scene);

/// @name Parts of declare()
/// @{
void declare_mesh(Entries &entries, geometry::BodyMeshParameters &mesh);
void add_gravity(Entries &entries, std::vector<double> &gravity);
/// Loads on faces, each called as @p key says.
void declare_loads(Entries &entries, LoadParameters &loads, const std::string &key);
void declare_load_cases(Entries &entries, Scene &scene);
/// Obstacles, contact and its pairs.
void declare_contact(Entries &entries, Scene &scene);
void declare_shapes(Entries &entries, Scene &scene);
void declare_responses(Entries &entries, Scene &scene);
void declare_optimization(Entries &entries, Scene &scene);
/// @}
} // namespace snug::scene

#endif
