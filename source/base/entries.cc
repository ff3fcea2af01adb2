#include <snug/base/entries.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace snug {
namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();

Form in_range(const Interval &interval, const std::string &range)
{
  Form form;
  form.interval = interval;
  form.range    = range;
  return form;
}

/// Entries by the names that they had in earlier versions, see CHANGELOG.md.
const TextMap former_names = {{"Mesh file", "File"}};

/// Return whether a value of the type @p given in a JSON file may be that of an entry.
bool accepts(const ValueType of_entry, const ValueType given)
{
  switch (of_entry)
    {
      case ValueType::text:
        return given == ValueType::text || given == ValueType::number ||
               given == ValueType::boolean;
      case ValueType::whole_number:
        return given == ValueType::number;
      case ValueType::whole_numbers:
        return given == ValueType::numbers;
      default:
        return given == of_entry;
    }
}

/// Assign @p text, where the former name of a choice stands for its name.
/// @throws InputError unless the text has the form of the entry.
void assign(const Entries::Description &entry, const Origins &origins, std::string text)
{
  const auto &choices = entry.form.choices;
  if (const auto renamed = entry.form.renamed.find(text); renamed != entry.form.renamed.end())
    text = renamed->second;
  try
    {
      if (choices.empty() || std::find(choices.begin(), choices.end(), text) != choices.end())
        return entry.access.assign(text);
    }
  catch (const std::exception &)
    {}
  const bool is_whole = entry.form.allowed.find("whole number") != std::string::npos;
  throw origins.error(entry.path(), text,
                      "must be " + entry.form.allowed + (is_whole ? "" : decimal_point_hint(text)),
                      suggestion(text, choices));
}

/// Return the error of the numbers of an entry; "" if there is no error.
std::string
failure_reason(const Form &form, const std::vector<double> &numbers, const unsigned int dimension)
{
  // Limit of numbers, such that sums of squares of products of two numbers do not overflow.
  const double largest = 1e60;
  if (!form.per_dimension.empty() && !numbers.empty() && numbers.size() != dimension)
    return "must have " + to_text(dimension) + " " + form.per_dimension + ", one per dimension";
  for (const double number : numbers)
    {
      if (!form.interval.contains(number))
        return form.range;
      if (std::abs(number) > largest)
        return "must be at most " + to_text(largest) + " in absolute value";
    }
  return "";
}
} // namespace

Access count_or_auto(unsigned int &number)
{
  return {[&number]() { return number == 0 ? "auto" : to_text(number); },
          [&number](const std::string &text) {
            unsigned int read = 0;
            if (text != "auto")
              from_text(text, read);
            if (text != "auto" && read == 0)
              throw std::invalid_argument("zero");
            number = read;
          }};
}

Form allowed(const std::string &description)
{
  Form form;
  form.allowed = description;
  return form;
}

Form choice(const Names &names)
{
  Form form;
  for (const auto &[name, meaning, former] : names)
    {
      form.choices.push_back(name);
      if (!meaning.empty())
        form.meanings.push_back({name, meaning});
      if (!former.empty())
        form.renamed[former] = name;
    }
  form.allowed = (form.choices.size() > 1 ? "one of " : "") + to_text(form.choices);
  return form;
}

Form with_meanings(Form form, const Names &meanings)
{
  form.meanings = meanings;
  return form;
}

Form positive()
{
  return in_range({0., infinity, false}, "must be positive");
}

Form at_least(const double lower, const std::string &range)
{
  return in_range({lower}, range.empty() ? "must be at least " + to_text(lower) : range);
}

Form at_most(const double upper)
{
  return in_range({-infinity, upper}, "must be at most " + to_text(upper));
}

Form between(const double lower, const double upper)
{
  return in_range({lower, upper}, "must lie between " + to_text(lower) + " and " + to_text(upper));
}

Form above(const double lower, const double upper)
{
  return in_range({lower, upper, false},
                  "must be above " + to_text(lower) +
                    (std::isfinite(upper) ? " and at most " + to_text(upper) : ""));
}

Form inside(const double lower, const double upper)
{
  return in_range({lower, upper, false, false},
                  "must be above " + to_text(lower) + " and below " + to_text(upper));
}

std::string range_of(const Form &form)
{
  for (const std::string verb : {"must be ", "must lie "})
    if (form.range.rfind(verb, 0) == 0)
      return ", " + form.range.substr(verb.size());
  return "";
}

Form per_dimension(Form form, const std::string &what)
{
  form.per_dimension = what;
  return form;
}

void Entries::begin_section(const std::string &name, const std::string &meaning)
{
  section_list.push_back({name, meaning});
}

void Entries::add(const std::string &name,
                  const Access      &access,
                  const Form        &form,
                  const std::string &meaning)
{
  list.push_back({section_list.back().name, name, access.text(), form, meaning, access});
}

void Entries::set(const Statement &statement)
{
  const auto entry = std::find_if(list.begin(), list.end(), [&statement](const Description &known) {
    return known.section == statement.section && known.name == statement.name;
  });
  if (entry == list.end())
    return reject_unknown(statement);
  const Origins origins("", {statement});
  if (statement.type && !accepts(entry->form.type, *statement.type))
    throw origins.error(statement.path(), statement.value,
                        "must be " + to_text(entry->form.type) + " in JSON");
  assign(*entry, origins, statement.value);
}

void Entries::check(const Origins &origins, const unsigned int dimension) const
{
  for (const auto &entry : list)
    {
      // A program may have set values that no text would: infinities, or choices that do not
      // exist. Assigning the text of a value to the variable finds them.
      const std::string text = entry.access.text();
      assign(entry, origins, text);
      if (!entry.access.numbers)
        continue;
      const auto wrong = failure_reason(entry.form, entry.access.numbers(), dimension);
      if (!wrong.empty())
        throw origins.error(entry.path(), text, wrong);
    }
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
  const auto did_you_mean = [](const std::string &name) {
    return name.empty() ? "" : "; did you mean '" + name + "'?";
  };
  if (names.empty())
    {
      const auto section = suggestion(statement.section, section_names);
      throw InputError("unknown subsection '" + quotable(statement.section) + "'" +
                         did_you_mean(section) +
                         " (names of subsections such as Body NAME stand in lists such as "
                         "'Bodies')",
                       statement.origin, {statement.section, "", "", section});
    }
  if (statement.name.empty())
    return;
  const auto former = former_names.find(statement.name);
  const auto name   = elsewhere.empty() ? suggestion(statement.name, names) : "";
  if (former != former_names.end() &&
      std::find(names.begin(), names.end(), former->second) != names.end())
    elsewhere = "; it was renamed to '" + former->second + "'";
  throw InputError("unknown entry '" + quotable(statement.path()) + "' = '" +
                     quotable(statement.value) + "'" +
                     (elsewhere.empty() ? did_you_mean(name) : elsewhere),
                   statement.origin, {statement.path(), statement.value, "", name});
}

void Entries::print(std::ostream &out) const
{
  for (const auto &section : section_list)
    {
      const std::string indent = section.name.empty() ? "" : "  ";
      std::size_t       width  = 0;
      for (const auto &entry : list)
        if (entry.section == section.name)
          width = std::max(width, entry.name.size());
      if (!section.name.empty())
        out << "subsection " << section.name << '\n';
      for (const auto &entry : list)
        if (entry.section == section.name)
          out << indent << "set " << entry.name << std::string(width - entry.name.size(), ' ')
              << " = " << entry.access.text() << '\n';
      if (!section.name.empty())
        out << "end\n";
    }
}
} // namespace snug
