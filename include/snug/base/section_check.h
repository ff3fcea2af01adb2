#ifndef snug_base_section_check_h
#define snug_base_section_check_h

#include <snug/base/entries.h>
#include <snug/base/statements.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace snug {
/// One subsection of a scene, for checks that concern several entries and are not part of the
/// form of one entry.
class SectionCheck
{
public:
  /// @p name "" is the top. @p where must outlive this object.
  SectionCheck(const std::string &name, const Origins &where, unsigned int of_scene)
    : dimension(of_scene), origins(where), section(name)
  {}

  const unsigned int dimension; ///< dimension of the scene

  std::string path(const std::string &entry) const;

  /// Return the error of an entry, with its origin.
  InputError error(const std::string &entry,
                   const std::string &value,
                   const std::string &allowed,
                   const std::string &suggestion = "") const;

  /// Throw the error of an entry unless the entry is @p good.
  void require(bool               good,
               const std::string &entry,
               const std::string &value,
               const std::string &allowed,
               const std::string &suggestion = "") const
  {
    if (!good)
      throw error(entry, value, allowed, suggestion);
  }

  /// Return read(text, dimension), whose std::invalid_argument is thrown as the error of the entry
  /// that contains @p text. @p what stands before its message.
  template <typename Read>
  auto read(const std::string &entry,
            const std::string &value,
            const std::string &what,
            const Read        &read_text,
            const std::string &text) const
  {
    try
      {
        return read_text(text, dimension);
      }
    catch (const std::invalid_argument &wrong)
      {
        throw error(entry, value, what + quotable(wrong.what()));
      }
  }

  /// Return an error "entry 'Box cells' = ..." of a module with origin and section of the entry
  /// that it names. If the error names none, use @p entry.
  InputError
  placed(const InputError &error, const std::string &entry, const std::string &value) const;

  /// Throw unless all entries of @p parameters that are not in @p read have their defaults;
  /// @p allowed states the reason.
  template <typename Parameters>
  void require_read(const Parameters               &parameters,
                    const std::vector<std::string> &read,
                    const std::string              &allowed) const
  {
    Parameters given = parameters, initial;
    Entries    of_given, of_initial;
    given.declare(of_given);
    initial.declare(of_initial);
    require_default(of_given, of_initial, read, allowed);
  }

private:
  void require_default(const Entries                  &given,
                       const Entries                  &initial,
                       const std::vector<std::string> &read,
                       const std::string              &allowed) const;

  const Origins &origins;
  std::string    section;
};
} // namespace snug

#endif
