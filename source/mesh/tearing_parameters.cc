#include <snug/base/entries.h>
#include <snug/mesh/partition.h>

#include <stdexcept>

namespace snug::mesh {
void TearingParameters::declare(Entries &entries)
{
  const auto text = [this]() { return subdomains == 0 ? "auto" : to_text(subdomains); };
  const auto read = [this](const std::string &text) {
    unsigned int number = 0;
    if (text != "auto")
      from_text(text, number);
    if (text != "auto" && number == 0)
      throw std::invalid_argument("no subdomain");
    subdomains = number;
  };
  entries.add("Subdomains", {text, read},
              with_meanings(allowed("auto or a whole number of at least 1"),
                            {{"auto", "number that follows from the numbers of cells and ranks"}}),
              "The target number of subdomains of all bodies on all ranks. The minimum is one per "
              "rank.");
  entries.add("Method", method, choice(names(partition_table<3>())),
              "The method that divides a body into subdomains.");
}
} // namespace snug::mesh
