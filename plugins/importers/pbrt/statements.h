#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <pbrt_syntax/lexer.h>
#include <pbrt_syntax/parameters.h>
#include <string>
#include <string_view>
#include <vector>

#include "../shared/read_file.h"

namespace pharos::pbrt {

/// A directive of a scene file with everything that belongs to it.
struct Statement {
  std::string word;                ///< "Shape", "Translate", …
  Location where;                  ///< of the word
  std::vector<std::string> texts;  ///< before the parameters: the type "sphere", a name, …
  std::vector<double> numbers;     ///< of transforms
  Parameters parameters;

  /// The first text: the type of an object, or a name.
  const std::string& type() const { return texts.front(); }
};

/// Reads the directives of a scene file, and of the files that it includes where they are included.
/// File names are relative to the folder of the outermost file. A file by `Import` stands between
/// `AttributeBegin` and `AttributeEnd`.
class StatementReader {
 public:
  /// Throws InputError if the file cannot be read.
  StatementReader(const std::filesystem::path& file, importing::ReadingBudget& budget);
  ~StatementReader();

  /// Returns the next directive, or nothing at the end. Throws InputError for unknown directives
  /// (with the nearest one), missing texts and numbers, bad parameters, files that include
  /// themselves, and scenes larger than the budget.
  std::optional<Statement> next();

  /// The place after the last directive.
  Location end() const { return end_; }

 private:
  struct File;

  void open(const std::filesystem::path& path, bool is_import);
  void include(const Statement& statement);
  Statement read_statement(const Token& word);

  std::filesystem::path folder_;
  importing::ReadingBudget& budget_;
  std::vector<std::unique_ptr<File>> files_;  ///< the outermost first
  Location end_;
};

/// Returns the file that a scene in `folder` means by `name`.
std::filesystem::path file_in(const std::filesystem::path& folder, const std::string& name);

}  // namespace pharos::pbrt
