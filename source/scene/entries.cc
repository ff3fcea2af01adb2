#include <snug/scene/entries.h>

#include <algorithm>
#include <ostream>

namespace snug::scene {
void Entries::begin_section(const std::string &name, const std::string &meaning)
{
  section_list.push_back({name, meaning});
}

void Entries::add(const std::string &name,
                  const Access      &access,
                  const Form        &form,
                  const std::string &meaning)
{
  const std::string &section = section_list.back().name;
  if (!section.empty())
    prm.enter_subsection(section);
  prm.declare_entry(name, access.text(), *form.pattern, meaning);
  prm.add_action(name, access.assign);
  if (!section.empty())
    prm.leave_subsection();
  list.push_back({section, name, access.text(), form, meaning});
}

void Entries::set(const Statement &statement)
{
  const auto entry = std::find_if(list.begin(), list.end(), [&statement](const Description &known) {
    return known.section == statement.section && known.name == statement.name;
  });
  if (entry == list.end())
    return reject_unknown(statement);
  bool valid = true;
  if (!statement.section.empty())
    prm.enter_subsection(statement.section);
  // The pattern or the action refuses; what it says is for programmers.
  try
    {
      prm.set(statement.name, statement.value);
    }
  catch (const std::exception &)
    {
      valid = false;
    }
  if (!statement.section.empty())
    prm.leave_subsection();
  if (!valid)
    throw Origins(statement.origin, {})
      .error(statement.path(), statement.value,
             "must be " + entry->form.allowed + did_you_mean(statement.value, entry->form.choices));
}

void Entries::reject_unknown(const Statement &statement) const
{
  std::vector<std::string> section_names, names;
  std::string              elsewhere;
  for (const auto &section : section_list)
    if (!section.name.empty())
      section_names.push_back(section.name);
  for (const auto &entry : list)
    {
      if (entry.section == statement.section)
        names.push_back(entry.name);
      else if (entry.name == statement.name)
        elsewhere = entry.section.empty() ? "; it belongs outside of subsections"
                                          : "; it belongs to subsection '" + entry.section + "'";
    }
  const std::string origin = statement.origin + ": ";
  if (names.empty())
    throw InputError(origin + "unknown subsection '" + quotable(statement.section) + "'" +
                     did_you_mean(statement.section, section_names) +
                     " (bodies, materials and shapes need a name in "
                     "'Bodies', 'Materials' or 'Shapes')");
  if (statement.name.empty())
    return;
  throw InputError(origin + "unknown entry '" + quotable(statement.path()) + "' = '" +
                   quotable(statement.value) + "'" +
                   (elsewhere.empty() ? did_you_mean(statement.name, names) : elsewhere));
}

void Entries::print(std::ostream &out) const
{
  prm.print_parameters(out, dealii::ParameterHandler::ShortPRM |
                              dealii::ParameterHandler::KeepDeclarationOrder);
}

const std::vector<Entries::Section> &Entries::sections() const
{
  return section_list;
}

const std::vector<Entries::Description> &Entries::descriptions() const
{
  return list;
}
} // namespace snug::scene
