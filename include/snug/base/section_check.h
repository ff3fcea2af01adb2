#ifndef snug_base_section_check_h
#define snug_base_section_check_h

#include <snug/base/entries.h>

#include <string>
#include <vector>

namespace snug {
/// One subsection of a scene, for checks of what entries cannot say of
/// themselves because it depends on others.
class SectionCheck
{
public:
  /// @p name "": the top. @p where must outlive this object.
  SectionCheck(const std::string &name, const Origins &where, unsigned int of_scene)
    : dimension(of_scene), origins(where), section(name)
  {}

  const unsigned int dimension; ///< of the scene

  std::string path(const std::string &entry) const;

  /// The error of an entry, with its origin.
  InputError
  error(const std::string &entry, const std::string &value, const std::string &allowed) const;

  /// Throw it unless the entry is @p good.
  void require(bool               good,
               const std::string &entry,
               const std::string &value,
               const std::string &allowed) const
  {
    if (!good)
      throw error(entry, value, allowed);
  }

  /// An error that a module throws, "entry 'Box cells' = ...", with origin
  /// and section of that entry; if it names none, of @p entry.
  InputError
  placed(const InputError &error, const std::string &entry, const std::string &value) const;

  /// Throw unless all entries of @p parameters that are not in @p read
  /// have their defaults; @p allowed says why they must.
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
