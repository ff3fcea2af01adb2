#ifndef snug_scene_section_check_h
#define snug_scene_section_check_h

#include <snug/scene/statements.h>

#include <string>

namespace snug::scene {
/// Checks entries of one subsection.
class SectionCheck
{
public:
  /// @p origins must outlive this object.
  SectionCheck(const std::string &section, const Origins &origins)
    : origins(origins), section(section)
  {}

  std::string path(const std::string &entry) const { return section + "/" + entry; }

  /// @throws InputError with the entry's origin unless it is @p good.
  void require(const bool         good,
               const std::string &entry,
               const std::string &value,
               const std::string &allowed) const
  {
    if (!good)
      throw origins.error(path(entry), value, allowed);
  }

protected:
  const Origins &origins;

private:
  std::string section;
};
} // namespace snug::scene

#endif
