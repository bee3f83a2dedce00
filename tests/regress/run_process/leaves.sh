# Answers what each kind of question takes.
while read -r line; do
  id=${line#*\"id\":}
  id=${id%%,*}
  case $line in
    *'"do":"begin"'*) echo "{\"id\":$id,\"answer\":\"ready\"}" ;;
    *'"do":"measure"'*)
      echo '{"set":"weather","value":"Windy"}'
      echo "{\"id\":$id,\"value\":\"Good\"}" ;;
    *'"do":"halt"'*) echo "{\"id\":$id,\"answer\":\"halted\"}" ;;
    *'"leaf":"goto"'*) echo "{\"id\":$id,\"answer\":\"running\"}" ;;
    *'"do":"end"'*) exit 0 ;;
    *) echo "{\"id\":$id,\"answer\":\"success\"}" ;;
  esac
done
