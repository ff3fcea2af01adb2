#include <snug/app/read_deck.h>
#include <snug/base/errors.h>
#include <snug/base/values.h>
#include <snug/mesh_file/deck_text.h>

#include <algorithm>
#include <filesystem>

namespace snug::app {
/// Replace a deck by its parameter file, and return the translation, which is empty for other
/// texts.
/// @throws InputError naming the file, also if the text must be a deck, but is not.
deck::Translation translate_deck(scene::SceneSource &source, const bool must_be_deck)
{
  if (!deck::is_deck(source.text))
    {
      if (must_be_deck)
        throw InputError(source.file +
                         ": option '--translate' needs a CAD file, which ends with .step, "
                         ".stp, .iges, .igs, .brep or .brp, FILE.prm, a model in JSON, or a deck "
                         "of Abaqus or CalculiX, which begins with a keyword such as *NODE");
      return {};
    }
  try
    {
      const auto directory = std::filesystem::path(source.file).parent_path();
      source.text = mesh_file::with_includes(source.text, [&](const std::string &included) {
        return source.read_file((directory / included).string());
      });
      const auto translation =
        deck::translate(source.text, std::filesystem::path(source.file).filename().string());
      source.text = translation.text;
      source.file += " (translated)";
      return translation;
    }
  catch (const InputError &error)
    {
      throw InputError(error.what(), {source.file}, error.wrong());
    }
}

namespace {
/// List the parts of the model of a deck that the run lacks. @throws InputError unless the option
/// --leave-out accepts all of their kinds.
void require_accepted(RunContext                           &context,
                      const Options                        &options,
                      const std::vector<deck::LackingPart> &lacking)
{
  std::vector<std::string> kinds, accepted;
  from_text(options.leave_out, accepted);
  for (const auto &part : lacking)
    if (std::find(kinds.begin(), kinds.end(), part.kind) == kinds.end())
      kinds.push_back(part.kind);
  for (const auto &name : accepted)
    if (std::find(kinds.begin(), kinds.end(), name) == kinds.end())
      throw InputError(options.file + ": option '--leave-out': the deck has no '" + name +
                       "' that must be left out" +
                       (kinds.empty() ? "" : ", but " + to_text(kinds)));
  const bool are_accepted = std::all_of(kinds.begin(), kinds.end(), [&](const auto &kind) {
    return std::find(accepted.begin(), accepted.end(), kind) != accepted.end();
  });
  for (const auto &part : lacking)
    if (are_accepted)
      context.warn({"deck", options.file + ": left out: " + part.text});
    else
      context.out(Verbosity::quiet)
        << options.file << ": not translated: " << part.text << std::endl;
  if (!are_accepted)
    throw InputError(options.file +
                     ": the model has parts that are not translated, see above; "
                     "--leave-out \"" +
                     to_text(kinds) + "\" runs it without them");
}
} // namespace

void report_translation(RunContext              &context,
                        const Options           &options,
                        const deck::Translation &translation)
{
  require_accepted(context, options, translation.lacking);
  for (const auto &line : translation.replaced)
    context.warn({"deck", options.file + ": " + line});
  if (!translation.not_needed.empty())
    context.out() << options.file << ": not needed: " << translation.not_needed << std::endl;
}
} // namespace snug::app
